#include "optimize/search/smoother_ground.hpp"

#include "glissade/core/math.hpp"

#include "optimize/discretise/guess.hpp"

#include <algorithm>
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
MeshTrack moved_along(const ScaledProblem& problem, const Transcription& track, const Vector& z, double from,
                      double to) {
  const auto moved = [&](double share) {
    return share <= from ? share * to / from : to + (share - from) * (1.0 - to) / (1.0 - from);
  };
  GuessCurve curve = curve_of(track, z);
  for (double& share : curve.sigma) share = moved(share);
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
  /// Place of the change, over the length of the track.
  [[nodiscard]] double share_at(double left) const { return math::pow(nearest_, left) * place_ / length_; }

  [[nodiscard]] bool begin() {
    const Problem nearest = nearer(1.0);
    const Candidate track = Searcher(nearest, options_, control_, progress_).search(passages_);
    if (!track.kept || track.stopped) return false;
    return take(*track.found, *track.problem, 1.0);
  }

  [[nodiscard]] MeshTrack next_of(const Problem& problem, double left) const {
    const double before = share_at(left_);
    const double to = std::min(share_at(left), 0.5 * (1.0 + before));
    return moved_along(scaled(problem, passages_), *track_, z_, before, to);
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
    if (!(length > math::pow(nearest_, left) * place_)) return false;
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
  }
  return tracks;
}

}  // namespace glissade::optimizer
