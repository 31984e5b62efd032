#include "optimize/mesh/moved_knots.hpp"

#include "optimize/descent/programs.hpp"
#include "optimize/mesh/free_spans.hpp"
#include "optimize/mesh/knot_groups.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace glissade::optimizer {
namespace {

/// Where places of a mesh go with the groups in it: what lies between two of them, or up to an end or a change of
/// friction, is stretched.
class Map {
 public:
  Map(const Mesh& mesh, const std::vector<KnotGroup>& groups) : mesh_(mesh), groups_(groups) {
    for (const ChangeKnots& change : mesh.change_knots) {
      held_.push_back(change.from);
      held_.push_back(change.to);
    }
    held_.push_back(0.0);
    held_.push_back(1.0);
    std::sort(held_.begin(), held_.end());
  }

  /// Half the way up to where the next group, or what is held, lies.
  [[nodiscard]] double room(std::size_t group) const {
    const double from = mesh_.knots[groups_[group].first];
    const double to = mesh_.knots[groups_[group].last];
    double before = held_before(from);
    double behind = held_behind(to);
    if (group > 0) before = std::max(before, mesh_.knots[groups_[group - 1].last]);
    if (group + 1 < groups_.size()) behind = std::min(behind, mesh_.knots[groups_[group + 1].first]);
    return 0.5 * std::min(from - before, behind - to);
  }

  [[nodiscard]] Mesh moved(const Vector& by) const {
    Mesh result = mesh_;
    for (double& knot : result.knots) knot = image(knot, by);
    for (double& sigma : result.fine) sigma = image(sigma, by);
    return result;
  }

 private:
  [[nodiscard]] double held_before(double sigma) const {
    return *(std::upper_bound(held_.begin(), held_.end(), sigma) - 1);
  }
  [[nodiscard]] double held_behind(double sigma) const {
    return *std::min(std::lower_bound(held_.begin(), held_.end(), sigma), held_.end() - 1);
  }
  [[nodiscard]] double image(double sigma, const Vector& by) const {
    double before = held_before(sigma);
    double behind = held_behind(sigma);
    if (before == behind) return sigma;
    double moved_before = before;
    double moved_behind = behind;
    for (std::size_t j = 0; j < groups_.size(); ++j) {
      const double from = mesh_.knots[groups_[j].first];
      const double to = mesh_.knots[groups_[j].last];
      if (sigma >= from && sigma <= to) return sigma + by[j];
      if (to < sigma && to > before) {
        before = to;
        moved_before = to + by[j];
      } else if (from > sigma && from < behind) {
        behind = from;
        moved_behind = from + by[j];
      }
    }
    return moved_before + (sigma - before) / (behind - before) * (moved_behind - moved_before);
  }

  const Mesh& mesh_;
  const std::vector<KnotGroup>& groups_;
  Vector held_;
};

/// On another mesh, all else fixed. @return none where it has other rows
std::optional<double> lagrangian_on(const ScaledProblem& problem, const Mesh& mesh, const Found& found) {
  const Transcription track(mesh);
  if (track.stations().size() != found.track->stations().size()) return std::nullopt;
  Rows rows(problem, track);
  rows.set_margins(found.rows->margins());
  const State state = rows.state(found.z, false);
  double sum = rows.objective(state);
  const Vector equality = rows.equality_values(state);
  for (std::size_t i = 0; i < equality.size(); ++i) sum += found.equality[i] * equality[i];
  for (std::size_t i = 0; i < found.active.size(); ++i) {
    if (found.inequality[i] > 0.0) sum += found.inequality[i] * rows.value(state, found.active[i]);
  }
  return sum;
}

/// By which the optimum changes with the place of each group.
Vector slopes_of(const ScaledProblem& problem, const Found& found, const std::vector<KnotGroup>& groups) {
  constexpr double kStep = 1e-4;  // rounding: of the room
  const Map map(found.track->mesh(), groups);
  Vector slopes(groups.size(), 0.0);
  for (std::size_t j = 0; j < groups.size(); ++j) {
    const double step = kStep * map.room(j);
    Vector by(groups.size(), 0.0);
    by[j] = step;
    const auto behind = lagrangian_on(problem, map.moved(by), found);
    by[j] = -step;
    const auto before = lagrangian_on(problem, map.moved(by), found);
    if (behind && before) slopes[j] = (*behind - *before) / (2.0 * step);
  }
  return slopes;
}

/// Inverse of the second derivative, as learnt from the steps.
/// Source: J. Nocedal, S. Wright, "Numerical Optimization" (2006), (6.17).
class InverseCurvature {
 public:
  explicit InverseCurvature(std::size_t n) : inverse_(n, n) {}

  void begin(double size) {
    for (std::size_t i = 0; i < inverse_.rows(); ++i) {
      for (std::size_t j = 0; j < inverse_.rows(); ++j) inverse_(i, j) = i == j ? size : 0.0;
    }
  }
  [[nodiscard]] Vector step_against(const Vector& slopes) const {
    Vector step(slopes.size(), 0.0);
    for (std::size_t i = 0; i < step.size(); ++i) step[i] = -dot(inverse_.row(i), slopes.data(), step.size());
    return step;
  }
  void learn(const Vector& step, const Vector& change) {
    const std::size_t n = step.size();
    const double along = dot(step.data(), change.data(), n);
    const double size = dot(change.data(), change.data(), n);
    if (!(along > 0.0)) return;
    if (std::exchange(is_new_, false)) begin(along / size);
    Vector turned(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) turned[i] = dot(inverse_.row(i), change.data(), n);
    const double both = dot(turned.data(), change.data(), n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        inverse_(i, j) += (1.0 + both / along) * step[i] * step[j] / along -
                          (turned[i] * step[j] + step[i] * turned[j]) / along;
      }
    }
  }

 private:
  Matrix inverse_;
  bool is_new_ = true;
};

Vector rooms_of(const Found& found, const std::vector<KnotGroup>& groups) {
  const Map map(found.track->mesh(), groups);
  Vector rooms;
  for (std::size_t j = 0; j < groups.size(); ++j) rooms.push_back(map.room(j));
  return rooms;
}

/// Of two vectors, element by element.
Vector times(const Vector& a, const Vector& b, double factor = 1.0) {
  Vector product(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) product[i] = factor * a[i] * b[i];
  return product;
}

/// What each jump of the curvature promises to win through its room, to first order; bends, too, where they count.
Vector promises_of(const ScaledProblem& problem, const Found& found, const KnotMoves& moves) {
  std::vector<KnotGroup> jumps = knot_groups_of(found);
  if (!moves.bends) std::erase_if(jumps, [](const KnotGroup& group) { return group.is_bend(); });
  return times(slopes_of(problem, found, jumps), rooms_of(found, jumps));
}

double sum_of_sizes(const Vector& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::fabs(value);
  return sum;
}

class KnotMover {
 public:
  KnotMover(const ScaledProblem& problem, const Found& begun, double tolerance, SearchControl& control,
            const KnotMoves& moves)
      : problem_(problem),
        tolerance_(tolerance),
        control_(control),
        moves_(moves),
        best_(begun),
        groups_(knot_groups_of(begun)),
        unit_(rooms_of(begun, groups_)),
        curvature_(groups_.size()) {}

  void run() {
    constexpr double kFirstStep = 0.05;  // of the room; taste
    const double size = std::fabs(best_.objective);
    Vector slopes = slopes_here();
    curvature_.begin(kFirstStep / std::max(greatest_size(slopes), moves_.at_rest * size));
    for (int round = 0; round < moves_.most_steps && greatest_size(slopes) > moves_.at_rest * size; ++round) {
      const double before = best_.objective;
      const Vector step = advance(curvature_.step_against(slopes));
      if (step.empty() || before - best_.objective < moves_.pays * size) break;
      Vector change = slopes_here();
      const Vector after = change;
      add_scaled(change.data(), -1.0, slopes.data(), change.size());
      curvature_.learn(step, change);
      slopes = after;
    }
  }
  [[nodiscard]] const Found& best() const { return best_; }

 private:
  [[nodiscard]] Vector slopes_here() const { return times(slopes_of(problem_, best_, groups_), unit_); }

  /// As much of a step as there is room for, less where that wins nothing. @return what was gone; empty if nothing was
  [[nodiscard]] Vector advance(Vector step) {
    constexpr double kLongest = 0.7;   // of the room; taste
    constexpr int kMostShorter = 3;    // budget
    constexpr double kShorter = 0.25;  // taste
    const Vector room = rooms_of(best_, groups_);
    double part = 1.0;
    for (std::size_t j = 0; j < step.size(); ++j) {
      const double way = std::fabs(step[j]) * unit_[j];
      if (part * way > kLongest * room[j]) part = kLongest * room[j] / way;
    }
    for (int shorter = 0; shorter <= kMostShorter && !control_.stop(); ++shorter, part *= kShorter) {
      const Mesh mesh = Map(best_.track->mesh(), groups_).moved(times(step, unit_, part));
      control_.tolerance = kAimed * tolerance_;
      control_.most_rounds = 0;
      // Where friction changes most jumps lie where they belong, and a step that gets lost is one too long.
      const bool was_close = std::exchange(control_.is_close, !problem_.changes.empty());
      Found trial = minimise(problem_, mesh, best_.z, best_.rows->margins(), control_, &best_);
      control_.is_close = was_close;
      const bool does = !trial.stopped && trial.residual <= tolerance_ &&
                        trial.feasible(control_.limit_tolerance) && trial.objective < best_.objective;
      if (!does) continue;
      best_ = std::move(trial);
      for (double& way : step) way *= part;
      return step;
    }
    return {};
  }

  const ScaledProblem& problem_;
  double tolerance_;
  SearchControl& control_;
  KnotMoves moves_;
  Found best_;
  std::vector<KnotGroup> groups_;
  Vector unit_;  ///< of the steps: the rooms at the beginning
  InverseCurvature curvature_;
};

}  // namespace

MovedKnots with_moved_knots(const ScaledProblem& problem, const Found& begun, double tolerance,
                            SearchControl& control, const KnotMoves& moves) {
  // Whether a jump of the curvature lies so far from where it belongs that it is worth more than the mesh costs.
  const Vector promises = promises_of(problem, begun, moves);
  if (!(greatest_size(promises) > moves.worth * std::fabs(begun.objective)))
    return {std::nullopt, sum_of_sizes(promises)};
  const bool is_far = sum_of_sizes(promises) > moves.far * std::fabs(begun.objective);
  if (is_far && can_free_spans(problem)) return {with_free_spans(problem, begun, tolerance, control), 0.0};
  KnotMover mover(problem, begun, tolerance, control, moves);
  mover.run();
  if (!(mover.best().objective < begun.objective)) return {};
  return {mover.best(), 0.0};
}

}  // namespace glissade::optimizer
