#include "pipeline/redesign/ruled_letters.hpp"

#include <algorithm>

namespace glissade::pipeline {

void tighten(std::optional<RuledBound>& bound, double value, const Rule& rule, double sign, double by_speed) {
  if (!bound || sign * value > sign * bound->value) bound = RuledBound{value, &rule, by_speed};
}

bool applies(const Rule& rule, const Measurements& measurements) {
  return std::all_of(rule.when.begin(), rule.when.end(), [&](const RuleCondition& condition) {
    return is_met(condition, measurements).value_or(false);
  });
}

RuledLetters ruled_letters(const Design& design, const Measurements& measurements, double v0) {
  RuledLetters letters;
  for (const Rule& rule : design.rules.in_force) {
    if (!applies(rule, measurements)) continue;
    const Range& bound = rule.bound;
    if (rule.quantity == "in_run_slope_angle" && bound.highest)
      tighten(letters.steepest, *bound.highest, rule, -1.0);
    if (rule.quantity == "transition_radius" && bound.lowest)
      tighten(letters.radius, *bound.lowest, rule, 1.0);
    if (rule.quantity == "design_radial_acceleration" && bound.highest)
      tighten(letters.radius, v0 * v0 / *bound.highest, rule, 1.0, 2.0 * v0 / *bound.highest);
    if (rule.quantity == "table_length" && bound.lowest) tighten(letters.table, *bound.lowest, rule, 1.0);
    if (rule.quantity == "table_time" && bound.lowest)
      tighten(letters.table, v0 * *bound.lowest, rule, 1.0, *bound.lowest);
  }
  return letters;
}

LetterBounds bounds_of(const RuledLetters& ruled) {
  LetterBounds bounds;
  if (ruled.steepest) bounds.gamma.highest = ruled.steepest->value;
  if (ruled.radius) bounds.r1.lowest = ruled.radius->value;
  if (ruled.table) bounds.t.lowest = ruled.table->value;
  return bounds;
}

}  // namespace glissade::pipeline
