#include "optimize/conflicts/mean_slope.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace glissade::optimizer {
namespace {

// What the bound that would do leaves beside the mean slope; the straight line alone has just that [deg].
constexpr double kRoom[] = {0.002, 0.05, 0.5};  // taste
constexpr double kRounded = 100.0;              // taste: told to hundredths of a degree

/// A bound a little beyond the mean slope, a round number of degrees.
double beyond(Angle mean, double room, Bound bound) {
  const double degrees = bound == Bound::highest ? std::ceil((mean.degrees() + room) * kRounded)
                                                 : std::floor((mean.degrees() - room) * kRounded);
  return Angle::from_degrees(degrees / kRounded).radians();
}

Angle mean_slope(const Problem& problem) {
  return Angle::from_radians(math::atan2(problem.endpoints.drop, std::fabs(problem.endpoints.run)));
}

/// The mean slopes that free ends leave, and the limits on slopes of which every track has its mean one somewhere [rad].
Range mean_slopes(const Problem& problem) {
  const Endpoints& ends = problem.endpoints;
  const double run = std::fabs(ends.run);
  const Range& free = problem.finish.free_range;
  Range means{-kRightAngle, kRightAngle};
  switch (problem.finish.kind) {
    case FinishKind::point:
      means = Range::fixed(mean_slope(problem).radians());
      return means;
    case FinishKind::vertical_line:
      if (free.lowest) means.lowest = math::atan2(*free.lowest, run);
      if (free.highest) means.highest = math::atan2(*free.highest, run);
      break;
    case FinishKind::level:
      if (free.highest && ends.drop >= 0.0) means.lowest = math::atan2(ends.drop, *free.highest);
      if (free.lowest && *free.lowest > 0.0 && ends.drop >= 0.0)
        means.highest = math::atan2(ends.drop, *free.lowest);
      break;
    case FinishKind::anywhere:
      break;
  }
  const Range& allowed = problem.limits.slope_angle;
  if (allowed.lowest) means.lowest = std::max(*means.lowest, *allowed.lowest);
  if (allowed.highest) means.highest = std::min(*means.highest, *allowed.highest);
  return means;
}

}  // namespace

std::optional<Conflict> beside_mean_slope(const Problem& problem, double tolerance,
                                          const std::function<bool(const LimitName&, double)>& would_do) {
  if (problem.finish.kind != FinishKind::point) return std::nullopt;
  const Angle mean = mean_slope(problem);
  const Range& allowed = problem.limits.slope_angle;
  const bool too_flat = allowed.highest && *allowed.highest < mean.radians() - tolerance;
  const bool too_steep = allowed.lowest && *allowed.lowest > mean.radians() + tolerance;
  if (!too_flat && !too_steep) return std::nullopt;
  const LimitName limit{LimitId::slope_angle, too_flat ? Bound::highest : Bound::lowest};
  const double asked = too_flat ? *allowed.highest : *allowed.lowest;
  Conflict conflict;
  conflict.limits = {{limit, asked}};
  for (const double room : kRoom) {
    const double needed = beyond(mean, room, limit.bound);
    if (!would_do || !would_do(limit, needed)) continue;
    conflict.relaxations.push_back({limit, asked, needed});
    break;
  }
  conflict.text = conflict_text(conflict);
  conflict.why = "The mean slope from start to finish is " + angle_text(mean, 7) +
                 ", and every track has that slope somewhere (mean value theorem).";
  return conflict;
}

Problem with_mean_slope_allowed(Problem problem, double tolerance) {
  if (problem.finish.kind != FinishKind::point) return problem;
  const double mean = mean_slope(problem).radians();
  Range& allowed = problem.limits.slope_angle;
  const auto just_missed = [&](double by) { return by > 0.0 && by <= tolerance; };
  if (allowed.highest && just_missed(mean - *allowed.highest)) allowed.highest = mean;
  if (allowed.lowest && just_missed(*allowed.lowest - mean)) allowed.lowest = mean;
  return problem;
}

double least_load_anywhere(const Problem& problem) {
  const Limits& limits = problem.limits;
  const bool rests = problem.body.entry_speed == 0.0 && !landing_of(problem.body);
  const auto slopes_at = [&](const Range& own) {
    Range slopes{-kRightAngle, kRightAngle};
    for (const Range* range : {&own, &limits.slope_angle}) {
      if (range->lowest) slopes.lowest = std::max(*slopes.lowest, *range->lowest);
      if (range->highest) slopes.highest = std::min(*slopes.highest, *range->highest);
    }
    return slopes;
  };
  const auto least_across = [&](const Range& slopes) {
    return problem.gravity * std::min(math::cos(*slopes.lowest), math::cos(*slopes.highest));
  };
  Range entry = slopes_at(limits.entry_slope_angle);
  // Uphill nothing begins to move.
  if (rests) entry.lowest = std::max(*entry.lowest, 0.0);
  double least = 0.0;
  const bool lies_at_start = rests || limits.lead_in > 0.0;
  if (lies_at_start) least = std::max(least, least_across(entry));
  if (limits.concave || limits.lead_out > 0.0) {
    Range exit = slopes_at(limits.exit_slope_angle);
    if (*entry.lowest >= 0.0) exit.lowest = std::max(*exit.lowest, 0.0);
    least = std::max(least, least_across(exit));
  }
  Range means = mean_slopes(problem);
  // From rest nothing arrives where there is no drop.
  if (rests) means.lowest = std::max(*means.lowest, 0.0);
  if (limits.concave || (lies_at_start && *entry.lowest >= -*means.lowest))
    least = std::max(least, least_across(means));
  return least;
}

}  // namespace glissade::optimizer
