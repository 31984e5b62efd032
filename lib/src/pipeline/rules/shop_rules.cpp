#include "glissade/pipeline/shop_rules.hpp"

#include "glissade/core/quantity.hpp"
#include "glissade/design/rule_sets.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace glissade {
namespace {

/// One place as the rules of a track are judged: by what was measured there.
Measurements at_place(const ShopMeasurement& measured) {
  Measurements measurements;
  const auto see = [&](const char* key, const std::optional<double>& value) {
    if (value) {
      measurements.see(key, *value);
    } else {
      measurements.lack(key, "");
    }
  };
  see("part_thickness", measured.thickness);
  see("part_density", measured.density);
  measurements.see(measured.quantity, measured.in_units());
  return measurements;
}

bool is_shipped(const Rule& rule) {
  const std::vector<RuleSet>& sets = shipped_rule_sets();
  return std::any_of(sets.begin(), sets.end(), [&](const RuleSet& set) {
    return std::any_of(set.rules.begin(), set.rules.end(),
                       [&](const Rule& one) { return one.id == rule.id; });
  });
}

ShopCheck check_of(const Rule& rule) {
  ShopCheck check;
  check.rule = rule.id;
  check.value = "-";
  check.bound = bound_text(rule);
  check.source = rule.source;
  check.sentence = rule.sentence;
  check.certainty = word(rule.certainty);
  check.needs_checking = needs_checking(rule.certainty);
  return check;
}

/// A check with value and bound as they are measured at a place: in millimetres where the rule counts in thicknesses.
ShopCheck check_at(const Judgement& judgement, const ShopMeasurement& measured) {
  ShopCheck check = check_of(judgement.rule);
  const auto text = [&](double value) { return quantity_text(value, measured.dimension); };
  check.value = text(measured.value);
  check.where = measured.where;
  if (judgement.verdict == RuleVerdict::cannot_be_judged) {
    check.verdict = ShopVerdict::cannot_be_judged;
    check.where += ": " + judgement.reason;
    return check;
  }
  check.verdict = judgement.verdict == RuleVerdict::pass   ? ShopVerdict::pass
                  : judgement.verdict == RuleVerdict::warn ? ShopVerdict::warn
                                                           : ShopVerdict::fail;
  check.bound =
      (judgement.bound_is_highest ? "at most " : "at least ") + text(*judgement.bound * measured.unit);
  return check;
}

/// How well a place keeps a rule: its margin, of a bound other than 0 as a share of it.
double room_of(const Judgement& judgement) {
  if (!judgement.margin) return 0.0;
  return *judgement.bound == 0.0 ? *judgement.margin : *judgement.margin / std::fabs(*judgement.bound);
}

/// Whether a place says more against a part than another: broken before not known before kept, then the one with less room.
bool is_worse(const Judgement& one, const Judgement& other) {
  const auto rank = [](const Judgement& judgement) {
    if (judgement.verdict == RuleVerdict::pass) return 0;
    return judgement.verdict == RuleVerdict::cannot_be_judged ? 1 : 2;
  };
  if (rank(one) != rank(other)) return rank(one) > rank(other);
  return room_of(one) < room_of(other);
}

}  // namespace

std::vector<ShopCheck> judge_shop(const std::vector<Rule>& rules, const Workshop& workshop) {
  std::vector<ShopCheck> checks;
  for (const Rule& rule : rules) {
    std::optional<std::pair<Judgement, const ShopMeasurement*>> worst_place;
    bool measured_somewhere = false;
    for (const ShopMeasurement& measured : workshop.measured) {
      if (measured.quantity != rule.quantity) continue;
      measured_somewhere = true;
      for (Judgement& judgement : judge({rule}, at_place(measured))) {
        if (worst_place && !is_worse(judgement, worst_place->first)) continue;
        worst_place.emplace(std::move(judgement), &measured);
      }
    }
    if (worst_place) {
      checks.push_back(check_at(worst_place->first, *worst_place->second));
    } else if (!measured_somewhere && !is_shipped(rule)) {
      ShopCheck check = check_of(rule);
      check.verdict = ShopVerdict::cannot_be_judged;
      check.where = "nothing in this build has a " + std::string(rule_quantity(rule.quantity)->label);
      checks.push_back(std::move(check));
    }
  }
  return checks;
}

}  // namespace glissade
