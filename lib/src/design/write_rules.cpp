#include "design/write_rules.hpp"

#include <string>

namespace glissade::design_file {
namespace {

void add_bound(Group& group, const Range& bound, std::string_view quantity) {
  const RuleQuantity* const known = rule_quantity(quantity);
  if (known == nullptr) return;
  group.add("lowest", bound.lowest, known->dimension);
  group.add("highest", bound.highest, known->dimension);
}

std::string rule_condition(const RuleCondition& condition) {
  Group group;
  group.add("quantity", condition.quantity);
  add_bound(group, condition.range, condition.quantity);
  return group.inlined();
}

std::string rule(const Rule& rule) {
  Group group;
  group.add("id", in_quotes(rule.id));
  group.add("sentence", in_quotes(rule.sentence));
  group.add("quantity", rule.quantity);
  add_bound(group, rule.bound, rule.quantity);
  if (rule.advice) group.add("advice", "true");
  if (!rule.when.empty()) group.add("when", list_of(rule.when, rule_condition));
  group.add("source", in_quotes(rule.source));
  if (rule.certainty != Certainty::own) group.add("certainty", std::string(word(rule.certainty)));
  return group.inlined();
}

}  // namespace

bool are_given(const RulesDesign& rules) {
  return rules.sets || !rules.own.empty() || !rules.left_out.empty();
}

Group written_rules(const RulesDesign& rules) {
  Group group;
  if (rules.sets) group.add("sets", list_of(*rules.sets, in_quotes));
  if (!rules.own.empty()) group.add("own", list_of(rules.own, rule));
  if (!rules.left_out.empty()) group.add("leave_out", list_of(rules.left_out, in_quotes));
  return group;
}

}  // namespace glissade::design_file
