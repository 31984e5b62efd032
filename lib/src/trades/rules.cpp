#include "glissade/trades/rules.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace glissade {
namespace {

constexpr std::array<std::string_view, 7> kCertaintyWords = {
    "document", "secondary", "derived", "general-high", "general-medium", "general-low", "own"};

void require_quantity(std::string_view key) {
  if (rule_quantity(key) != nullptr) return;
  throw InternalError({"", "rules know no quantity " + std::string(key), "", ""});
}

double allowance(double bound) {
  // Nothing is relative to a bound of 0: a load of -1e-12 g is rounding, as Motion has it.
  constexpr double kLeastScale = 0.01;
  return kRuleAccuracy * std::max(std::fabs(bound), kLeastScale);
}

/// Whether a condition is met; none where that is not known.
std::optional<bool> holds(const RuleCondition& condition, const Measurements& measurements) {
  const Measurements::Entry* const entry = measurements.find(condition.quantity);
  if (entry == nullptr || !entry->value) return {};
  const Range& range = condition.range;
  return (!range.lowest || *entry->value >= *range.lowest - allowance(*range.lowest)) &&
         (!range.highest || *entry->value <= *range.highest + allowance(*range.highest));
}

std::string reason_of(const std::string& quantity, const Measurements::Entry* entry) {
  const std::string label(rule_quantity(quantity) == nullptr ? quantity : rule_quantity(quantity)->label);
  if (entry == nullptr) return "this track has no " + label;
  return entry->missing.empty() ? label + " is not known" : "the " + label + " needs " + entry->missing;
}

/// The side of a bound that is broken, or else the one next to the value.
void compare(Judgement& judgement, double value) {
  const Range& range = judgement.rule.bound;
  const auto margin_to = [&](double bound, bool highest) { return highest ? bound - value : value - bound; };
  const auto take = [&](double bound, bool highest) {
    const double margin = margin_to(bound, highest);
    if (judgement.margin && *judgement.margin <= margin) return;
    judgement.bound = bound;
    judgement.bound_is_highest = highest;
    judgement.margin = margin;
  };
  if (range.lowest) take(*range.lowest, false);
  if (range.highest) take(*range.highest, true);
  const bool kept = *judgement.margin >= -allowance(*judgement.bound);
  judgement.verdict = kept                    ? RuleVerdict::pass
                      : judgement.rule.advice ? RuleVerdict::warn
                                              : RuleVerdict::fail;
}

std::optional<Judgement> judged(const Rule& rule, const Measurements& measurements) {
  Judgement judgement;
  judgement.rule = rule;
  for (const RuleCondition& condition : rule.when) {
    const std::optional<bool> met = holds(condition, measurements);
    if (met && !*met) return {};
    if (met || !judgement.reason.empty()) continue;
    judgement.reason = reason_of(condition.quantity, measurements.find(condition.quantity));
  }
  const Measurements::Entry* const entry = measurements.find(rule.quantity);
  if (entry == nullptr || !entry->value || std::isnan(*entry->value)) {
    if (judgement.reason.empty()) judgement.reason = reason_of(rule.quantity, entry);
    return judgement;
  }
  judgement.value = entry->value;
  judgement.arc_length = entry->arc_length;
  judgement.place = entry->place;
  if (judgement.reason.empty()) compare(judgement, *entry->value);
  return judgement;
}

}  // namespace

std::string_view word(Certainty certainty) {
  return kCertaintyWords[static_cast<std::size_t>(certainty)];
}

const std::vector<Certainty>& certainties() {
  static const std::vector<Certainty> all = {
      Certainty::document,       Certainty::secondary,   Certainty::derived, Certainty::general_high,
      Certainty::general_medium, Certainty::general_low, Certainty::own};
  return all;
}

bool needs_checking(Certainty certainty) {
  return certainty != Certainty::document && certainty != Certainty::own;
}

const RuleQuantity* rule_quantity(std::string_view key) {
  for (const RuleQuantity& quantity : rule_quantities()) {
    if (quantity.key == key) return &quantity;
  }
  return nullptr;
}

void Measurements::set(std::string_view key, double value, std::optional<double> arc_length,
                       std::string place) {
  require_quantity(key);
  entries_[std::string(key)] = {value, arc_length, std::move(place), {}};
}

void Measurements::set_missing(std::string_view key, std::string missing) {
  require_quantity(key);
  entries_[std::string(key)] = {{}, {}, {}, std::move(missing)};
}

const Measurements::Entry* Measurements::find(std::string_view key) const {
  const auto found = entries_.find(key);
  return found == entries_.end() ? nullptr : &found->second;
}

std::string_view to_text(RuleVerdict verdict) {
  constexpr std::array<std::string_view, 4> kTexts = {"pass", "warn", "fail", "cannot be judged"};
  return kTexts[static_cast<std::size_t>(verdict)];
}

std::vector<Judgement> judge(const std::vector<Rule>& rules, const Measurements& measurements) {
  std::vector<Judgement> judgements;
  for (const Rule& rule : rules) {
    if (auto judgement = judged(rule, measurements)) judgements.push_back(*std::move(judgement));
  }
  return judgements;
}

RuleVerdict worst(const std::vector<Judgement>& judgements) {
  const auto rank = [](RuleVerdict verdict) {
    constexpr std::array<int, 4> kRanks = {0, 2, 3, 1};
    return kRanks[static_cast<std::size_t>(verdict)];
  };
  RuleVerdict verdict = RuleVerdict::pass;
  for (const Judgement& judgement : judgements) {
    if (rank(judgement.verdict) > rank(verdict)) verdict = judgement.verdict;
  }
  return verdict;
}

std::string bound_text(const Rule& rule) {
  const RuleQuantity* const quantity = rule_quantity(rule.quantity);
  const Dimension dimension = quantity == nullptr ? Dimension::number : quantity->dimension;
  const auto text = [&](double value) { return quantity_text(value, dimension); };
  if (rule.bound.is_fixed()) return text(*rule.bound.lowest);
  if (rule.bound.lowest && rule.bound.highest) {
    return text(*rule.bound.lowest) + " to " + text(*rule.bound.highest);
  }
  if (rule.bound.lowest) return ">= " + text(*rule.bound.lowest);
  return rule.bound.highest ? "<= " + text(*rule.bound.highest) : "";
}

}  // namespace glissade
