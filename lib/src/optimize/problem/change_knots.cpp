#include "optimize/problem/change_knots.hpp"

#include <algorithm>

namespace glissade::optimizer {
namespace {

// Width of the pieces that stand for a jump, by the length of the core. Measured: of four problems with corners or a
// radius at the change, 1e-3 costs 5e-5 to 9e-5 of the time, 1e-4 5e-6 to 8e-6, 1e-5 5e-7 to 8e-7.
constexpr double kWidth = 1e-6;
// Other knots are not as close: a track is not to bend there twice. Measured: from 1e-5 to 1e-3 the same tracks.
constexpr double kKnotsApart = 1e-4;
// A change this close to an end of the core is none in it.
constexpr double kAtEnd = 1e-9;  // rounding

bool jumps(const ScaledProblem& problem) {
  // Under a limit on its rate curvature does not.
  return std::none_of(problem.limits.begin(), problem.limits.end(),
                      [](const LimitSpec& limit) { return limit.measure == Measure::curvature_rate; });
}

/// Whether no limit on radius or load rounds a bend.
bool bends_sharply(const ScaledProblem& problem) {
  return std::none_of(problem.limits.begin(), problem.limits.end(), [](const LimitSpec& limit) {
    return limit.side > 0 && (limit.measure == Measure::curvature || limit.measure->is_load());
  });
}

}  // namespace

std::vector<ChangeKnots> change_knots(const ScaledProblem& problem, double core_length) {
  const Ride& ride = problem.rides[problem.objective_ride];
  const bool jump = jumps(problem);
  const bool sharp = bends_sharply(problem);
  std::vector<ChangeKnots> all;
  for (std::size_t i = 0; i < problem.changes.size(); ++i) {
    const double sigma = (problem.changes[i] - problem.lead_in) / core_length;
    if (!(sigma > kAtEnd && sigma < 1.0 - kAtEnd)) continue;
    const bool rougher = ride.friction_in(i + 1) > ride.friction_in(i);
    const double from = jump && rougher ? sigma - kWidth : sigma;
    const double to = jump && !rougher ? sigma + kWidth : sigma;
    const bool fits = from > kAtEnd && to < 1.0 - kAtEnd;
    all.push_back(fits ? ChangeKnots{sigma, from, to, sharp} : ChangeKnots{sigma, sigma, sigma, false});
  }
  return all;
}

Vector with_change_knots(const Vector& knots, const std::vector<ChangeKnots>& changes) {
  if (changes.empty()) return knots;
  Vector result;
  for (const double knot : knots) {
    const bool inner = knot > 0.0 && knot < 1.0;
    const bool close = std::any_of(changes.begin(), changes.end(), [&](const ChangeKnots& change) {
      return knot > change.from - kKnotsApart && knot < change.to + kKnotsApart;
    });
    if (!inner || !close) result.push_back(knot);
  }
  for (const ChangeKnots& change : changes) {
    result.push_back(change.sigma);
    if (change.from == change.to) continue;
    result.push_back(change.from == change.sigma ? change.to : change.from);
    if (change.sharp) result.push_back(0.5 * (change.from + change.to));
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace glissade::optimizer
