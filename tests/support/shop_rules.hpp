#pragma once

#include "glissade/design/rule_sets.hpp"
#include "glissade/pipeline/shop_rules.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace testing {

using namespace glissade;

/// @return the rules of a shipped set
inline std::vector<Rule> rules_named(const std::string& name) {
  for (const RuleSet& set : shipped_rule_sets()) {
    if (set.name == name) return set.rules;
  }
  return {};
}

/// @return what the shipped rules of a process say of parts
inline std::vector<ShopCheck> shop_checks(const Workshop& workshop, const std::string& process) {
  return judge_shop(rules_named("shop-" + process), workshop);
}

/// @return the check of a rule; one without an id where there is none
inline ShopCheck check_of(const std::vector<ShopCheck>& checks, const std::string& rule) {
  const auto found =
      std::find_if(checks.begin(), checks.end(), [&](const ShopCheck& check) { return check.rule == rule; });
  return found == checks.end() ? ShopCheck{} : *found;
}

}  // namespace testing
