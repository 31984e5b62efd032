#include "optimize/conflicts/energy_conflict.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include "optimize/conflicts/energy_left.hpp"

#include <cmath>
#include <utility>

namespace glissade::optimizer {
namespace {

constexpr double kSurely = 1.0 + 1e-6;  // accuracy: ten times that of a limit

/// Whether every track is long enough for a lowest speed on the way to begin.
bool begins_on_every_track(const Problem& problem) {
  const bool is_point = problem.finish.kind == FinishKind::point;
  return problem.limits.lowest_speed_from <=
         (is_point ? math::hypot(problem.endpoints.run, problem.endpoints.drop) : 0.0);
}

/// Where a lowest speed begins to hold before a body that falls is as fast.
std::optional<OutOfEnergy> begins_too_soon(const Problem& problem) {
  const Range& speed = problem.limits.speed;
  const double from = problem.limits.lowest_speed_from;
  if (!speed.lowest || !begins_on_every_track(problem)) return std::nullopt;
  const std::optional<double> most = most_speed_after(problem, from);
  if (!most || !(*speed.lowest > kSurely * *most)) return std::nullopt;
  const auto text = [](double value, int digits) { return quantity_text(value, Dimension::speed, digits); };
  const auto [reached, wanted] = texts_apart(*most, *speed.lowest, text);
  const double entry = problem.body.entry_speed;
  const double enough = (*speed.lowest * *speed.lowest - entry * entry) / (2.0 * problem.gravity);
  return OutOfEnergy{{{LimitId::speed, speed.is_fixed() ? Bound::exactly : Bound::lowest}, *speed.lowest},
                     "Whatever the shape of the track, a fall of " + length_text(from) + " gives at most " +
                         reached + ". " + wanted + " take one of " + length_text(enough) +
                         ": lowest_from has to be more than that, by what slope, friction and drag take."};
}

}  // namespace

std::optional<OutOfEnergy> out_of_energy(const Problem& problem) {
  const std::optional<double> most = most_speed_left(problem);
  if (!most) return begins_too_soon(problem);
  const Limits& limits = problem.limits;
  // A lowest speed on the way holds at the finish where every track is long enough for it to begin.
  const bool at_finish = begins_on_every_track(problem);
  for (const auto& [id, range] :
       {std::pair(LimitId::exit_speed, &limits.exit_speed), std::pair(LimitId::speed, &limits.speed)}) {
    if (!range->lowest || !(*range->lowest > kSurely * *most)) continue;
    if (id == LimitId::speed && !at_finish) continue;
    const double asked = *range->lowest;
    const double entry = problem.body.entry_speed;
    const auto text = [](double speed, int digits) { return quantity_text(speed, Dimension::speed, digits); };
    const auto [reached, wanted] = texts_apart(*most, asked, text);
    const double entry2 = entry * entry;
    const double drop = (asked * asked - entry2) / (2.0 * problem.gravity);
    const double faster = asked * asked - *most * *most + entry2;
    return OutOfEnergy{{{id, range->is_fixed() ? Bound::exactly : Bound::lowest}, asked},
                       "Whatever the shape of the track, the energy equation leaves at most " + reached +
                           " at the finish. " + wanted + " takes more than " + length_text(drop) +
                           " of drop, or " + text(std::sqrt(faster), 4) +
                           " at the entry; friction and drag add to that."};
  }
  return begins_too_soon(problem);
}

std::optional<std::string> too_fast(const Problem& problem) {
  const std::optional<double> left = least_speed_left(problem);
  if (!left) return std::nullopt;
  const Limits& limits = problem.limits;
  for (const std::optional<double>& highest : {limits.speed.highest, limits.exit_speed.highest}) {
    if (!highest || *left <= *highest) continue;
    return "However a track winds within these slopes, " + rounded_text(*left, 4) +
           " m/s or more are left at the finish: so the energy equation says.";
  }
  return std::nullopt;
}

}  // namespace glissade::optimizer
