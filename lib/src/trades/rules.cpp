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

std::string reason_of(const std::string& quantity, const Extremes* extremes) {
  const std::string label(rule_quantity(quantity) == nullptr ? quantity : rule_quantity(quantity)->label);
  if (extremes == nullptr) return "this track has no " + label;
  const std::string missing = extremes->missing().value_or("");
  return missing.empty() ? label + " is not known" : "the " + label + " needs " + missing;
}

/// One side of a rule, with the extreme that would break it first.
struct Side {
  const MeasuredValue* extreme = nullptr;
  double bound = 0.0;
  bool is_highest = true;

  [[nodiscard]] double margin() const { return is_highest ? bound - extreme->value : extreme->value - bound; }
  [[nodiscard]] bool is_kept() const { return margin() >= -allowance(bound); }
};

/// The side that is broken, or else the one nearest to that.
/// @param extremes  of which something was seen
Side nearest_to_breaking(const Range& range, const Extremes& extremes) {
  std::vector<Side> sides;
  if (range.lowest) sides.push_back({&*extremes.least(), *range.lowest, false});
  if (range.highest) sides.push_back({&*extremes.most(), *range.highest, true});
  return *std::min_element(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.is_kept() == b.is_kept() ? a.margin() < b.margin() : b.is_kept();
  });
}

std::optional<Judgement> judged(const Rule& rule, const Measurements& measurements) {
  Judgement judgement;
  judgement.rule = rule;
  for (const RuleCondition& condition : rule.when) {
    const std::optional<bool> met = is_met(condition, measurements);
    if (met && !*met) return {};
    if (met || !judgement.reason.empty()) continue;
    judgement.reason = reason_of(condition.quantity, measurements.find(condition.quantity));
  }
  const bool applies = judgement.reason.empty();
  const Extremes* const extremes = measurements.find(rule.quantity);
  if (extremes == nullptr || !extremes->least()) {
    if (applies) judgement.reason = reason_of(rule.quantity, extremes);
    return judgement;
  }
  const Side side = nearest_to_breaking(rule.bound, *extremes);
  judgement.value = side.extreme->value;
  judgement.arc_length = side.extreme->arc_length;
  judgement.place = side.extreme->place;
  if (!applies) return judgement;
  // What is broken is broken whatever else there is; kept it is only if all is known.
  if (side.is_kept() && extremes->missing()) {
    judgement.reason = reason_of(rule.quantity, extremes);
    return judgement;
  }
  judgement.bound = side.bound;
  judgement.bound_is_highest = side.is_highest;
  judgement.margin = side.margin();
  judgement.verdict = side.is_kept() ? RuleVerdict::pass
                      : rule.advice  ? RuleVerdict::warn
                                     : RuleVerdict::fail;
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

void Extremes::see(MeasuredValue value) {
  if (std::isnan(value.value)) {
    lack("");
    return;
  }
  if (!most_ || value.value > most_->value) most_ = value;
  if (!least_ || value.value < least_->value) least_ = std::move(value);
}

void Extremes::lack(std::string missing) {
  if (!missing_) missing_ = std::move(missing);
}

Extremes& Measurements::of(std::string_view key) {
  require_quantity(key);
  return extremes_[std::string(key)];
}

void Measurements::see(std::string_view key, double value, std::optional<double> arc_length,
                       std::string place) {
  see(key, MeasuredValue{value, arc_length, std::move(place)});
}

void Measurements::see(std::string_view key, MeasuredValue value) {
  of(key).see(std::move(value));
}

void Measurements::lack(std::string_view key, std::string missing) {
  of(key).lack(std::move(missing));
}

const Extremes* Measurements::find(std::string_view key) const {
  const auto found = extremes_.find(key);
  return found == extremes_.end() ? nullptr : &found->second;
}

std::optional<bool> is_met(const RuleCondition& condition, const Measurements& measurements) {
  const Extremes* const extremes = measurements.find(condition.quantity);
  if (extremes == nullptr || !extremes->least()) return {};
  const Range& range = condition.range;
  const bool meets =
      (!range.lowest || extremes->most()->value >= *range.lowest - allowance(*range.lowest)) &&
      (!range.highest || extremes->least()->value <= *range.highest + allowance(*range.highest));
  if (!meets && extremes->missing()) return {};
  return meets;
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

int digits_of(const Judgement& judgement) {
  constexpr int kUsual = 4;
  constexpr int kMost = 15;  // rounding: of a double
  const bool is_broken = judgement.verdict == RuleVerdict::warn || judgement.verdict == RuleVerdict::fail;
  if (!is_broken || !judgement.value || !judgement.bound) return kUsual;
  const Dimension dimension = rule_quantity(judgement.rule.quantity)->dimension;
  int digits = kUsual;
  while (digits < kMost && quantity_text(*judgement.value, dimension, digits) ==
                               quantity_text(*judgement.bound, dimension, digits))
    ++digits;
  return digits;
}

std::string bound_text(const Rule& rule, int digits) {
  const RuleQuantity* const quantity = rule_quantity(rule.quantity);
  const Dimension dimension = quantity == nullptr ? Dimension::number : quantity->dimension;
  const auto text = [&](double value) { return quantity_text(value, dimension, digits); };
  if (rule.bound.is_fixed()) return text(*rule.bound.lowest);
  if (rule.bound.lowest && rule.bound.highest) {
    return text(*rule.bound.lowest) + " to " + text(*rule.bound.highest);
  }
  if (rule.bound.lowest) return ">= " + text(*rule.bound.lowest);
  return rule.bound.highest ? "<= " + text(*rule.bound.highest) : "";
}

}  // namespace glissade
