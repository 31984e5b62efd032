#include "optimize/search/descents.hpp"

#include "optimize/descent/least_violation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace glissade::optimizer {
namespace {

// The lowest load is kept this far above its bound, in g: a body that weighs nothing at all has left the
// track.
constexpr double kContactMargin = 1e-6;  // accuracy: ten times that of a limit

/// Knots in shares of the core that do not depend on the track found: from a hundred-millionth on, each this factor
/// behind the one before.
Vector with_crest_knots(const Vector& knots) {
  constexpr double kFirst = 1e-8;  // taste
  constexpr double kFactor = 4.0;  // taste
  constexpr double kLast = 2e-3;   // taste: twice a pair of knots
  Vector result{0.0};
  double next = kFirst;
  for (; next < kLast; next *= kFactor) result.push_back(next);
  for (const double knot : knots) {
    if (knot > 0.75 * next) result.push_back(knot);
  }
  return result;
}

/// The mesh laid by the length of a track found, and that track on it.
MeshTrack relaid(const ScaledProblem& problem, const Found& found) {
  const Transcription& track = *found.track;
  const Mesh& before = track.mesh();
  const auto shares_of = [&](const Vector& places) {
    Vector shares;
    // All of it is 1: shares that add up to a last digit less would leave places behind the last knot.
    for (const double sigma : places)
      shares.push_back(sigma == 1.0 ? 1.0 : std::min(track.share_of_core(found.z, sigma), 1.0));
    return shares;
  };
  MeshTrack again;
  again.mesh = mesh_with(problem, shares_of(before.knots), core_length_of(found));
  again.mesh.extra_breaks = shares_of(before.extra_breaks);
  if (again.mesh.knots.size() != before.knots.size()) {
    again.z = fit(curve_of(track, found.z), Transcription(again.mesh));
    return again;
  }
  const Layout& layout = track.layout();
  const double length = again.mesh.core_length;
  again.mesh.fine = shares_of(before.fine);
  again.z = found.z;
  again.z[layout.length()] = length;
  for (std::size_t i = 0; i < layout.knots; ++i) {
    const std::size_t piece = std::max(i, std::size_t{1}) - 1;
    again.z[layout.turn(i)] *= length / track.stretch(found.z, piece);
  }
  for (const FineKnot& fine : track.fine_knots()) {
    again.mesh.fine_turns.push_back(fine.turn * length / track.stretch(found.z, fine.piece));
  }
  return again;
}

}  // namespace

double least_margin(const LimitSpec& limit) {
  return limit.measure == Measure::normal_load && limit.side < 0 ? kContactMargin : 0.0;
}

bool starts_with_crest(const ScaledProblem& problem) {
  if (problem.entry_speed2 > 0.0 || problem.lead_in > 0.0) return false;
  bool held = false;
  for (const LimitSpec& limit : problem.limits) {
    if (limit.measure == Measure::curvature_rate) return false;
    held = held || (limit.measure == Measure::entry_slope_angle && limit.side >= 0);
  }
  return held;
}

Mesh mesh_again(const Found& found) {
  Mesh mesh = found.track->mesh();
  if (!found.track->has_fixed_pieces()) mesh.core_length = core_length_of(found);
  return mesh;
}

Mesh mesh_with(const ScaledProblem& problem, Vector knots, double core_length) {
  if (starts_with_crest(problem)) knots = with_crest_knots(knots);
  return mesh_of(problem, std::move(knots), core_length);
}

void Descents::begin_margins(const ScaledProblem& problem) {
  const std::vector<LimitSpec>& limits = problem.limits;
  margins_.assign(limits.size(), 0.0);
  for (std::size_t i = 0; i < margins_.size(); ++i) margins_[i] = least_margin(limits[i]);
}

void Descents::aim_at(double tolerance, int most_rounds) {
  control_.tolerance = tolerance;
  control_.most_rounds = most_rounds;
}

Found Descents::minimised(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning,
                          const Found* known) {
  return minimise(problem, mesh, beginning, margins_, control_, known);
}

Found Descents::minimised_closely(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning,
                                  const Found& known) {
  control_.is_close = true;
  Found next = minimised(problem, mesh, beginning, &known);
  control_.is_close = false;
  return next;
}

Found Descents::kept_on(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning) {
  Relaxed relaxed =
      least_violation(problem, mesh, beginning, Elastic::all(problem.limits.size()), margins_, control_);
  relaxed.found.violation = relaxed.t;
  relaxed.found.residual = HUGE_VAL;
  return std::move(relaxed.found);
}

std::optional<Found> Descents::rescued(const ScaledProblem& problem, const Mesh& mesh,
                                       const Vector& beginning) {
  const Relaxed relaxed =
      least_violation(problem, mesh, beginning, Elastic::all(problem.limits.size()), margins_, control_);
  if (relaxed.t > kNearlyFeasible) return std::nullopt;
  Found found = minimised(problem, mesh, relaxed.found.z);
  if (!found.feasible(kNearlyFeasible)) return std::nullopt;
  return found;
}

Found Descents::on_mesh(const ScaledProblem& problem, const Mesh& mesh, const Vector& beginning,
                        const Found& known) {
  if (control_.any_track) return kept_on(problem, mesh, beginning);
  Found next = minimised(problem, mesh, beginning, &known);
  const bool is_lost = !next.feasible(kNearlyFeasible) && known.feasible(kNearlyFeasible);
  if (next.stopped || !is_lost || control_.is_close) return next;
  std::optional<Found> other = rescued(problem, mesh, beginning);
  return other ? std::move(*other) : next;
}

Found Descents::exactly(const ScaledProblem& problem, Found found) {
  if (!problem.changes.empty()) return found;  // as exact as can be
  const std::function<bool()> stop = control_.stop;
  const bool stopped = found.stopped;
  // However near the end of the time: a step or two.
  if (stopped) control_.stop = [] { return false; };
  aim_at_optimum(stopped ? 0 : 3);
  Found next = minimised_closely(problem, mesh_again(found), found.z, found);
  control_.stop = stop;
  const bool arrives = is_optimum(next);
  if (!arrives && is_optimum(found)) next = on_mesh(problem, mesh_again(found), found.z, found);
  next.stopped = stopped || control_.stop();
  return next;
}

Found Descents::laid_anew(const ScaledProblem& problem, Found found) {
  constexpr int kMostRounds = 6;         // budget
  constexpr double kSameLength = 1e-10;  // accuracy: a hundredth of that of a limit
  if (problem.changes.empty()) return found;
  const auto passed_by = [&](double length) {
    return std::lower_bound(problem.changes.begin(), problem.changes.end(), length) - problem.changes.begin();
  };
  const auto passes_others = [&](const Found& known) {
    const double laid = problem.lead_in + known.track->mesh().core_length;
    const double length = problem.lead_in + core_length_of(known);
    return passed_by(laid) != passed_by(length) ||
           passed_by(laid + problem.lead_out) != passed_by(length + problem.lead_out);
  };
  const auto is_off = [&](const Found& known) {
    return passes_others(known) ||
           std::fabs(core_length_of(known) / known.track->mesh().core_length - 1.0) > kSameLength;
  };
  for (int round = 0; round < kMostRounds && !found.stopped && is_off(found); ++round) {
    const MeshTrack again = relaid(problem, found);
    aim_at_optimum(3);
    Found next = on_mesh(problem, again.mesh, again.z, found);
    if (!next.feasible(kNearlyFeasible)) break;
    found = std::move(next);
  }
  // Of a friction that is not that of the track nothing is proved.
  if (passes_others(found)) found.residual = HUGE_VAL;
  return found;
}

}  // namespace glissade::optimizer
