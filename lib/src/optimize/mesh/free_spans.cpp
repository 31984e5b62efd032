#include "optimize/mesh/free_spans.hpp"

#include "optimize/mesh/knot_groups.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/mesh/switches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace glissade::optimizer {
namespace {

// How wide a jump is drawn, as a share of the core: of a time whose jumps take 1e-4 on pairs of knots it takes 2e-6.
constexpr double kRamp = 0.02 * kPair;  // accuracy: twice that of a time
// Of the length that a span begins with.
constexpr double kLongestSpan = 2.0;   // taste
constexpr double kShortestSpan = 0.4;  // taste

/// Limits on the lengths of spans, as measured by the mesh.
ScaledProblem with_room(ScaledProblem problem) {
  LimitSpec room;
  room.measure = Measure::span_length;
  room.built_in = true;
  for (const auto& [side, bound] : {std::pair{1, kLongestSpan}, std::pair{-1, kShortestSpan}}) {
    room.side = side;
    room.bound = bound;
    problem.limits.push_back(room);
  }
  return problem;
}

/// The same track: the last knot of each group counts twice, and another span begins there.
MeshTrack parted(const Found& found, const std::vector<KnotGroup>& groups) {
  const Transcription& track = *found.track;
  const Layout& layout = track.layout();
  const Vector& knots = track.mesh().knots;
  const double length = track.core_length(found.z);
  MeshTrack result;
  Mesh& mesh = result.mesh;
  mesh = track.mesh();
  mesh.core_length = length;
  mesh.knots.clear();
  result.z.push_back(found.z[layout.angle()]);
  auto group = groups.begin();
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const bool is_border = group != groups.end() && group->last == i;
    if (is_border) {
      ++group;
      mesh.borders.push_back(knots[i]);
      mesh.knots.push_back(knots[i]);
      result.z.push_back(found.z[layout.turn(i)]);
    }
    mesh.knots.push_back(knots[i]);
    result.z.push_back(found.z[layout.turn(i)]);
  }
  result.z.insert(result.z.end(), mesh.borders.size() + 1, length);
  return result;
}

/// Tells a track of several spans on a mesh of one length.
class Joining {
 public:
  explicit Joining(const Found& found)
      : z_(found.z),
        track_(*found.track),
        layout_(track_.layout()),
        knots_(track_.mesh().knots),
        length_(track_.core_length(z_)) {}

  [[nodiscard]] MeshTrack whole() && {
    Mesh& mesh = result_.mesh;
    mesh = track_.mesh();
    mesh.borders.clear();
    mesh.core_length = length_;
    mesh.knots.clear();
    for (double& sigma : mesh.extra_breaks) sigma = place(sigma);
    result_.z.push_back(z_[layout_.angle()]);
    for (std::size_t i = 0; i < layout_.knots; ++i) {
      if (was_ramp_at(i)) continue;
      if (is_border(i)) {
        add_border(i++);
      } else {
        add(i + 1 == layout_.knots ? 1.0 : place(knots_[i]), turn(i, i + 1 == layout_.knots ? i - 1 : i));
      }
    }
    result_.z.push_back(length_);
    add_fine_knots();
    return std::move(result_);
  }

 private:
  [[nodiscard]] double place(double sigma) const { return track_.share_of_core(z_, sigma); }
  /// Of the new mesh, at a knot of a piece.
  [[nodiscard]] double turn(std::size_t knot, std::size_t piece) const {
    return z_[layout_.turn(knot)] * length_ / track_.stretch(z_, piece);
  }
  [[nodiscard]] bool is_border(std::size_t knot) const {
    return knot + 1 < layout_.knots && knots_[knot] == knots_[knot + 1];
  }
  void add(double sigma, double turn) {
    result_.mesh.knots.push_back(sigma);
    result_.z.push_back(turn);
  }

  /// Whether a knot began what was a ramp, and curvature goes on in a line there, up to the jump at the border behind it.
  [[nodiscard]] bool was_ramp_at(std::size_t knot) const {
    constexpr double kLine = 0.1;  // taste: the optimum on the mesh without it follows
    if (knot == 0 || is_border(knot) || !is_border(knot + 1)) return false;
    const double width = knots_[knot + 1] - knots_[knot];
    const double before = knots_[knot] - knots_[knot - 1];
    if (!(width < 2.0 * kPair && width < before)) return false;
    const double from = turn(knot - 1, knot - 1);
    const double line = from + (turn(knot + 1, knot) - from) * before / (before + width);
    const double here = turn(knot, knot);
    return std::fabs(here - line) < kLine * std::max(std::fabs(here), std::fabs(line));
  }

  /// A ramp where curvature jumps at a border, one knot where it does not.
  void add_border(std::size_t knot) {
    constexpr double kSame = 1e-3;      // taste: of the greater turning rate
    constexpr double kOfPieces = 0.25;  // taste
    const double sigma = place(knots_[knot]);
    const double before = turn(knot, knot - 1);
    const double behind = turn(knot + 1, knot + 1);
    if (std::fabs(behind - before) <= kSame * std::max(std::fabs(behind), std::fabs(before))) {
      add(sigma, 0.5 * (before + behind));
      return;
    }
    const double room = std::min(sigma - place(knots_[knot - 1]), place(knots_[knot + 2]) - sigma);
    const double half = std::min(0.5 * kRamp, kOfPieces * room);
    add(sigma - half, before);
    add(sigma + half, behind);
  }

  void add_fine_knots() {
    Mesh& mesh = result_.mesh;
    mesh.fine.clear();
    mesh.fine_turns.clear();
    std::size_t piece = 0;
    for (const FineKnot& fine : track_.fine_knots()) {
      const double sigma = place(fine.sigma);
      while (mesh.knots[piece + 1] <= sigma) ++piece;
      // Not where it has come to lie within a ramp.
      const bool in_ramp = mesh.knots[piece + 1] - mesh.knots[piece] <= kRamp;
      if (in_ramp || !(mesh.knots[piece] < sigma)) continue;
      mesh.fine.push_back(sigma);
      mesh.fine_turns.push_back(fine.turn * length_ / track_.stretch(z_, fine.piece));
    }
  }

  const Vector& z_;
  const Transcription& track_;
  const Layout& layout_;
  const Vector& knots_;
  double length_;
  MeshTrack result_;
};

/// The limits on the lengths of spans are none of the problem's own.
void drop_room(const ScaledProblem& problem, Found& found) {
  for (std::size_t i = found.active.size(); i-- > 0;) {
    if (found.active[i].limit < problem.limits.size()) continue;
    found.active.erase(found.active.begin() + static_cast<std::ptrdiff_t>(i));
    found.inequality.erase(found.inequality.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// At which knots spans begin.
struct Freeing {
  bool bends = false;  ///< at those of bends, too
  double pays = 0.0;   ///< what a round has to win for another, as a share of the objective
};

/// @return the best one
Found freed(const ScaledProblem& problem, Found best, double tolerance, SearchControl& control,
            const Freeing& freeing) {
  constexpr int kMostRounds = 8;   // budget
  constexpr double kClose = 1e-5;  // accuracy: the optimum on the mesh of one length follows
  const ScaledProblem roomy = with_room(problem);
  for (int round = 0; round < kMostRounds && !control.stop(); ++round) {
    std::vector<KnotGroup> groups = knot_groups_of(best);
    if (!freeing.bends) std::erase_if(groups, [](const KnotGroup& group) { return group.is_bend(); });
    if (groups.empty()) break;
    const MeshTrack apart = parted(best, groups);
    Vector margins = best.rows->margins();
    margins.resize(roomy.limits.size(), 0.0);
    control.tolerance = kClose;
    control.most_rounds = 0;
    Found spans = minimise(roomy, apart.mesh, apart.z, margins, control, &best);
    drop_room(problem, spans);
    const MeshTrack together = Joining(spans).whole();
    control.tolerance = kAimed * tolerance;
    Found trial = minimise(problem, together.mesh, together.z, best.rows->margins(), control, &spans);
    const bool does = !trial.stopped && trial.residual <= tolerance &&
                      trial.feasible(control.limit_tolerance) && trial.objective < best.objective;
    if (!does) break;
    const double won = best.objective - trial.objective;
    best = std::move(trial);
    if (won < freeing.pays * std::fabs(best.objective)) break;
  }
  return best;
}

}  // namespace

bool can_free_spans(const ScaledProblem& problem) {
  const bool at_a_place = std::any_of(problem.limits.begin(), problem.limits.end(), holds_from_a_place) &&
                          problem.lowest_speed_from > problem.lead_in;
  return problem.changes.empty() && !at_a_place && problem.rides.front().law == nullptr &&
         !is_smooth(problem);
}

std::optional<Found> with_free_spans(const ScaledProblem& problem, const Found& begun, double tolerance,
                                     SearchControl& control) {
  constexpr Freeing kJumps{false, 5e-7};  // accuracy: half that of a time
  constexpr Freeing kBends{true, 1e-5};   // accuracy: ten times that of a time, as each round takes long
  Found best = freed(problem, begun, tolerance, control, kJumps);
  best = freed(problem, std::move(best), tolerance, control, kBends);
  if (!(best.objective < begun.objective)) return std::nullopt;
  return best;
}

}  // namespace glissade::optimizer
