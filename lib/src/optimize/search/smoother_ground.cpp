#include "optimize/search/smoother_ground.hpp"

#include "glissade/core/math.hpp"

#include "optimize/discretise/guess.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

// A change is drawn as near as half the length of the track found: most of that track then lies on smoother ground.
constexpr double kNear = 0.5;  // theory: any that leaves it on the track
// And comes back by this part of the way at a time, each with the track before as its start, ...
constexpr double kFirstStep = 0.125;  // budget
// ... or by less where the search gets lost, down to this.
constexpr double kLeastStep = 5e-3;  // budget
// Ground further away than this many lengths of the track found is not looked at.
constexpr double kFar = 4.0;  // budget

/// With the changes up to one of them this share of the way from the start.
Problem with_nearer_changes(Problem problem, std::size_t last, double share) {
  for (std::size_t i = 0; i <= last; ++i) problem.body.friction_changes[i].from *= share;
  return problem;
}

/// Where a track that another problem has led to begins in this one: its bends go along with the change.
/// @param from,to  where the change was and is, over the length of the track
/// @param longer   its length, of what it was
MeshTrack moved_along(const ScaledProblem& problem, const Transcription& track, const Vector& z, double from,
                      double to, double longer) {
  const auto moved = [&](double share) {
    return share <= from ? share * to / from : to + (share - from) * (1.0 - to) / (1.0 - from);
  };
  GuessCurve curve = curve_of(track, z);
  for (double& share : curve.sigma) share = moved(share);
  curve.length *= longer;
  Vector knots;
  for (const double knot : track.mesh().knots) knots.push_back(moved(track.share_of_core(z, knot)));
  Mesh mesh = mesh_of(problem, std::move(knots), curve.length);
  Vector begun = fit(curve, Transcription(mesh));
  return {std::move(mesh), std::move(begun)};
}

/// The track with a change nearer to the start, drawn back to where it is.
class DrawnBack {
 public:
  DrawnBack(const Problem& problem, const Passages& passages, std::size_t change, double length,
            const OptimizeOptions& options, SearchControl& control, const Progress& progress)
      : problem_(problem),
        passages_(passages),
        change_(change),
        place_(problem.body.friction_changes[change].from),
        nearest_(kNear * length / place_),
        options_(options),
        control_(control),
        progress_(progress) {}

  [[nodiscard]] std::optional<Candidate> run() {
    if (!begin()) return std::nullopt;
    // The part of the way back that is left, and of it the next step, halved where the search gets lost.
    double left = 1.0;
    double step = kFirstStep;
    while (left > 0.0 && step > kLeastStep && !control_.stop()) {
      const double next = left > step * (1.0 + 1e-9) ? left - step : 0.0;
      if (next == 0.0 ? end() : go_on(next)) {
        left = next;
      } else {
        step *= 0.5;
      }
    }
    return left > 0.0 ? std::nullopt : std::move(ended_);
  }

 private:
  [[nodiscard]] Problem nearer(double left) const {
    return with_nearer_changes(problem_, change_, math::pow(nearest_, left));
  }
  /// Place of the change [m].
  [[nodiscard]] double place_at(double left) const { return math::pow(nearest_, left) * place_; }

  [[nodiscard]] bool begin() {
    const Problem nearest = nearer(1.0);
    const Candidate track = Searcher(nearest, options_, control_, progress_).search(passages_);
    if (!track.kept || track.stopped) return false;
    return take(*track.found, *track.problem, 1.0);
  }

  [[nodiscard]] MeshTrack next_of(const Problem& problem, double left) const {
    const double before = place_at(left_) / length_;
    const ScaledProblem next = scaled(problem, passages_);
    if (problem.finish.kind == FinishKind::point) {
      const double to = std::min(place_at(left) / length_, 0.5 * (1.0 + before));
      return moved_along(next, *track_, z_, before, to, 1.0);
    }
    // To a free finish what lies on smoother ground stays as long as it is.
    const double length = length_ + place_at(left) - place_at(left_);
    return moved_along(next, *track_, z_, before, place_at(left) / length, length / length_);
  }

  [[nodiscard]] bool go_on(double left) {
    const Problem problem = nearer(left);
    const MeshTrack begun = next_of(problem, left);
    Searcher searcher(problem, options_, control_, progress_);
    Searcher::Stage stage = searcher.carried_along(passages_, begun.mesh, begun.z);
    const bool arrives = !stage.found.stopped && stage.found.feasible(kNearlyFeasible);
    return arrives && take(stage.found, *stage.candidate.rough, left);
  }

  [[nodiscard]] bool end() {
    const MeshTrack begun = next_of(problem_, 0.0);
    Searcher searcher(problem_, options_, control_, progress_);
    Searcher::Stage stage = searcher.carried_on(passages_, begun.mesh, begun.z);
    ended_ = searcher.ended(std::move(stage));
    return ended_->kept && !ended_->stopped && ended_->track->length() > place_;
  }

  /// @return whether the track goes on behind the change
  [[nodiscard]] bool take(const Found& found, const ScaledProblem& scaled, double left) {
    const double length =
        scaled.chord * (scaled.lead_in + found.track->core_length(found.z) + scaled.lead_out);
    if (!(length > place_at(left))) return false;
    track_ = found.track;
    z_ = found.z;
    length_ = length;
    left_ = left;
    return true;
  }

  const Problem& problem_;
  const Passages& passages_;
  std::size_t change_;
  double place_;    ///< [m]
  double nearest_;  ///< where it is drawn to, of that
  const OptimizeOptions& options_;
  SearchControl& control_;
  const Progress& progress_;

  // The last one on the way.
  std::shared_ptr<const Transcription> track_;
  Vector z_;
  double length_ = 0.0;  ///< [m]
  double left_ = 1.0;    ///< of the way
  std::optional<Candidate> ended_;
};

/// Finishes of a problem that leaves one coordinate of it free, as far from the start as a change of friction is along the track,
/// and some farther.
std::vector<Endpoints> finishes_beyond(const Problem& problem, double place) {
  constexpr double kShares[] = {0.95, 1.05, 1.3};  // taste: of the way there
  const bool level = problem.finish.kind == FinishKind::level;
  if (!level && problem.finish.kind != FinishKind::vertical_line) return {};
  const Endpoints& given = problem.endpoints;
  const double known = level ? given.drop : std::fabs(given.run);
  std::vector<Endpoints> all;
  for (const double share : kShares) {
    const double square = share * place * share * place - known * known;
    double free = square > 0.0 ? std::sqrt(square) : 0.0;
    const Range& range = problem.finish.free_range;
    if (range.lowest) free = std::max(free, *range.lowest);
    if (range.highest) free = std::min(free, *range.highest);
    if (!(free > 0.0)) continue;
    const Endpoints ends =
        level ? Endpoints{std::copysign(free, given.run), given.drop} : Endpoints{given.run, free};
    const bool is_known = std::any_of(all.begin(), all.end(), [&](const Endpoints& one) {
      return one.run == ends.run && one.drop == ends.drop;
    });
    if (!is_known) all.push_back(ends);
  }
  return all;
}

/// The track to one finish, and the search from there with that free again. @return none where there is none
std::optional<Candidate> by_a_finish(const Problem& problem, const Endpoints& ends, const Passages& passages,
                                     const OptimizeOptions& options, SearchControl& control,
                                     const Progress& progress) {
  Problem fixed = problem;
  fixed.endpoints = ends;
  fixed.finish = {};
  const Candidate known = Searcher(fixed, options, control, progress).search(passages);
  if (!known.kept || known.stopped) return std::nullopt;
  const ScaledProblem freed = scaled(problem, passages);
  const MeshTrack begun =
      moved_along(freed, *known.found->track, known.found->z, 0.5, 0.5, known.problem->chord / freed.chord);
  Searcher searcher(problem, options, control, progress);
  Candidate end = searcher.search_from(passages, begun.mesh, begun.z);
  // Bends that are next to none on smoother ground are lost to other meshes: as it is, the track may still be the better one.
  Candidate as_it_is = searcher.mended(passages, begun.mesh, begun.z);
  if (!end.kept || (as_it_is.kept && as_it_is.found->objective < end.found->objective))
    end = std::move(as_it_is);
  if (!end.kept || end.stopped) return std::nullopt;
  return end;
}

}  // namespace

std::vector<Candidate> on_smoother_ground(const Problem& problem, const Passages& passages,
                                          const Candidate& found, const OptimizeOptions& options,
                                          SearchControl& control, const Progress& progress) {
  std::vector<Candidate> tracks;
  const double length = found.track->length();
  double before = problem.body.friction.coefficient();
  for (std::size_t i = 0; i < problem.body.friction_changes.size(); ++i) {
    const FrictionChange& change = problem.body.friction_changes[i];
    const bool smoother = change.friction.coefficient() < before;
    before = change.friction.coefficient();
    // Most of the track lies on it already.
    const bool is_near = change.from <= kNear * length;
    if (!smoother || is_near || change.from > kFar * length || control.stop()) continue;
    auto track = DrawnBack(problem, passages, i, length, options, control, progress).run();
    if (track) tracks.push_back(*std::move(track));
    // Where the finish is free a track that only just comes there may be none to draw back; one to a finish that lies there is.
    for (const Endpoints& ends : track ? std::vector<Endpoints>{} : finishes_beyond(problem, change.from)) {
      if (auto end = by_a_finish(problem, ends, passages, options, control, progress))
        tracks.push_back(*std::move(end));
    }
  }
  return tracks;
}

}  // namespace glissade::optimizer
