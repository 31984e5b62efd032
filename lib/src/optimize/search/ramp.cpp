#include "optimize/search/ramp.hpp"

#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/math.hpp"

#include "optimize/problem/changed_bound.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace glissade::optimizer {
namespace {

// A body on an upright track weighs nothing and may leave it: limits on the load are kept with as much to spare.
constexpr double kFromUpright = 1e-6;  // accuracy: [rad], ten times that of a limit
constexpr int kHalvings = 60;          // rounding: of a double's digits
constexpr double kLongest = 20.0;      // taste: drops of free fall

/// What the lowest exit speed is held by: the body that arrives slowest.
std::optional<double> exit_speed_of(const referee::Judgement& judgement) {
  if (!judgement.arrived) return std::nullopt;
  for (const LimitCheck& check : judgement.checks) {
    if (check.limit.id == LimitId::exit_speed && check.limit.bound != Bound::highest) return check.reached;
  }
  return std::nullopt;
}

Ramp ramp_of(const Problem& problem, double slope_angle, double length) {
  const Endpoints ends{length * math::cos(slope_angle), length * math::sin(slope_angle)};
  const CenterlinePtr line = std::make_shared<StraightLine>(ends);
  return {line, referee::judge_track(problem, line, referee::kRefereeSamples)};
}

bool reaches(const Problem& problem, const Ramp& ramp) {
  const std::optional<double> speed = exit_speed_of(ramp.judgement);
  return speed && *speed >= *problem.limits.exit_speed.lowest;
}

/// The ramp at the least value at which the exit speed is reached. @pre it is reached at `enough`, and not at `too_little`
template <typename RampAt>
Ramp barely_reaching(const Problem& problem, double too_little, double enough, const RampAt& ramp_at) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (too_little + enough);
    (reaches(problem, ramp_at(middle)) ? enough : too_little) = middle;
  }
  return ramp_at(enough);
}

}  // namespace

std::optional<Ramp> steepest_ramp(const Problem& problem) {
  const Limits& limits = problem.limits;
  if (problem.finish.kind != FinishKind::anywhere || !limits.exit_speed.lowest) return std::nullopt;
  double steepest = 0.5 * std::numbers::pi - kFromUpright;
  for (const Range* range : {&limits.slope_angle, &limits.entry_slope_angle, &limits.exit_slope_angle})
    steepest = std::min(steepest, range->highest.value_or(steepest));
  const double speed = *limits.exit_speed.lowest;
  const double entry = problem.body.entry_speed;
  const double fall = (speed * speed - entry * entry) / (2.0 * problem.gravity);
  if (!(steepest > 0.0 && fall > 0.0)) return std::nullopt;
  const auto of_length = [&](double length) { return ramp_of(problem, steepest, length); };
  double length = fall;
  while (!reaches(problem, of_length(length))) {
    length *= 2.0;
    if (length > kLongest * fall) return std::nullopt;
  }
  const double ends = limits.lead_in + limits.lead_out;
  if (ends > 0.0 && reaches(problem, of_length(ends))) {
    return barely_reaching(problem, 0.0, steepest,
                           [&](double angle) { return ramp_of(problem, angle, ends); });
  }
  return barely_reaching(problem, ends, length, of_length);
}

double measure_of(const Centerline& track, ObjectiveKind objective) {
  return objective == ObjectiveKind::least_length ? track.length() : track.endpoints().drop;
}

std::vector<ActiveLimit> active_limits(const Ramp& ramp, const Problem& problem) {
  constexpr double kStep = 1e-5;     // rounding: of a bound, the cube root of a double's digits
  constexpr double kTouches = 1e-6;  // accuracy: ten times that of a limit
  std::vector<ActiveLimit> active;
  for (const LimitCheck& check : ramp.judgement.checks) {
    if (std::fabs(check.reached - check.value) > kTouches * check.scale) continue;
    const double step = kStep * std::max(std::fabs(check.value), check.scale);
    const auto measure_at = [&](double value) -> std::optional<double> {
      const std::optional<Problem> changed = with_bound(problem, check.limit, value);
      if (!changed) return std::nullopt;
      const std::optional<Ramp> other = steepest_ramp(*changed);
      return other ? std::optional(measure_of(*other->line, problem.objective.kind)) : std::nullopt;
    };
    const std::optional<double> more = measure_at(check.value + step);
    const std::optional<double> less = measure_at(check.value - step);
    if (!more || !less) continue;
    ActiveLimit limit;
    limit.limit = check.limit;
    limit.value = check.value;
    limit.price = std::fabs(*more - *less) / (2.0 * step);
    if (!(limit.price > 0.0)) continue;
    const bool at_exit = check.limit.id == LimitId::exit_speed;
    limit.where.push_back({at_exit ? ramp.line->length() : 0.0, ramp.line->length()});
    active.push_back(std::move(limit));
  }
  return active;
}

}  // namespace glissade::optimizer
