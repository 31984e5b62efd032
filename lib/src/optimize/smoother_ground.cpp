#include "optimize/smoother_ground.hpp"

#include "glissade/core/math.hpp"

#include "optimize/guess.hpp"

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

/// The search for a problem from the track that another one has led to, whose bends go along with the change.
/// @param from,to  where the change was and is, over the length of the track
Candidate followed(Searcher& searcher, const Problem& problem, const Passages& passages,
                   const Candidate& before, double from, double to) {
  const Transcription& track = *before.found->track;
  const Vector& z = before.found->z;
  const auto moved = [&](double share) {
    return share <= from ? share * to / from : to + (share - from) * (1.0 - to) / (1.0 - from);
  };
  GuessCurve curve = curve_of(track, z);
  for (double& share : curve.sigma) share = moved(share);
  Vector knots;
  for (const double knot : track.mesh().knots) knots.push_back(moved(track.share_of_core(z, knot)));
  const Mesh mesh = mesh_of(scaled(problem, passages), std::move(knots), curve.length);
  return searcher.search_from(passages, mesh, fit(curve, Transcription(mesh)));
}

std::optional<Candidate> drawn_back(const Problem& problem, const Passages& passages, std::size_t change,
                                    double length, const OptimizeOptions& options, SearchControl& control,
                                    const Progress& progress) {
  const double place = problem.body.friction_changes[change].from;
  const double nearest = std::min(1.0, kNear * length / place);
  double share_before = 1.0;
  const auto found_at = [&](double left, const std::optional<Candidate>& before) -> std::optional<Candidate> {
    const double share = math::pow(nearest, left);
    const Problem nearer = with_nearer_changes(problem, change, share);
    Searcher searcher(nearer, options, control, progress);
    Candidate track;
    if (before) {
      const double now = before->track->length();
      const double to = std::min(share * place / now, 0.5 * (1.0 + share_before * place / now));
      track = followed(searcher, nearer, passages, *before, share_before * place / now, to);
    } else {
      track = searcher.search(passages);
    }
    if (!track.kept || track.stopped || track.track->length() <= share * place) return std::nullopt;
    share_before = share;
    return track;
  };
  // The part of the way back that is left, and of it the next step, halved where the search gets lost.
  double left = 1.0;
  double step = kFirstStep;
  std::optional<Candidate> last = found_at(left, {});
  while (last && left > 0.0 && step > kLeastStep && !control.stop()) {
    const double next = left > step * (1.0 + 1e-9) ? left - step : 0.0;
    std::optional<Candidate> track = found_at(next, last);
    if (!track) {
      step *= 0.5;
      continue;
    }
    last = std::move(track);
    left = next;
  }
  return left > 0.0 ? std::nullopt : std::move(last);
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
    if (!smoother || change.from > kFar * length || control.stop()) continue;
    auto track = drawn_back(problem, passages, i, length, options, control, progress);
    if (track) tracks.push_back(*std::move(track));
  }
  return tracks;
}

}  // namespace glissade::optimizer
