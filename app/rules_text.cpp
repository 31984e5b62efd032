#include "app/rules_text.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/words.hpp"
#include "glissade/pipeline/rules.hpp"

#include "app/console.hpp"
#include "app/summary.hpp"
#include "app/table.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace glissade::app {
namespace {

std::string verdict_text(RuleVerdict verdict) {
  const std::string text(to_text(verdict));
  if (verdict == RuleVerdict::pass) return emphasised(text, Emphasis::good);
  return verdict == RuleVerdict::fail ? emphasised(text, Emphasis::bad) : text;
}

std::string line_of(const Judgement& judgement) {
  const Rule& rule = judgement.rule;
  std::string text = verdict_text(judgement.verdict) + ": " + rule.id + ", " +
                     std::string(rule_quantity(rule.quantity)->label);
  if (judgement.value) text += " " + measured_text(judgement);
  return text + ", " + marked_bound_text(judgement);
}

std::string counted(std::size_t count, const std::string& what) {
  return count_text(count) + " " + what;
}

/// What would have to be known, once for all the rules that ask it: "unknown: hill: {size: 142 m}, ... (a, b)"
std::vector<std::string> open_questions(const std::vector<Judgement>& judgements) {
  std::vector<std::pair<std::string, std::vector<std::string>>> asked;
  for (const Judgement& judgement : judgements) {
    if (judgement.verdict != RuleVerdict::cannot_be_judged) continue;
    const auto same = std::find_if(asked.begin(), asked.end(),
                                   [&](const auto& one) { return one.first == judgement.reason; });
    if (same != asked.end()) {
      same->second.push_back(judgement.rule.id);
    } else {
      asked.push_back({judgement.reason, {judgement.rule.id}});
    }
  }
  std::vector<std::string> lines;
  lines.reserve(asked.size());
  for (const auto& [reason, rules] : asked) lines.push_back(listed(rules) + ":\n  " + reason);
  return lines;
}

}  // namespace

std::string rules_lines(const std::vector<Judgement>& judgements) {
  if (judgements.empty()) return "";
  const auto count = [&](RuleVerdict verdict) {
    return static_cast<std::size_t>(std::count_if(
        judgements.begin(), judgements.end(), [&](const Judgement& one) { return one.verdict == verdict; }));
  };
  std::string text = counted(count(RuleVerdict::pass), "pass") + ", " +
                     counted(count(RuleVerdict::warn), "warn") + ", " +
                     counted(count(RuleVerdict::fail), "fail") + ", " +
                     counted(count(RuleVerdict::cannot_be_judged), "cannot be judged");
  bool marked = false;
  for (const Judgement& judgement : judgements) {
    marked = marked || needs_checking(judgement.rule.certainty);
    const bool told = judgement.verdict == RuleVerdict::warn || judgement.verdict == RuleVerdict::fail;
    if (told) text += "\n" + line_of(judgement);
  }
  for (const std::string& line : open_questions(judgements)) text += "\ncannot be judged: " + line;
  if (marked)
    text += "\nbounds not read in the document itself; their certainty stands in [ ], \"glissade rules\"";
  return labelled("Rules", text);
}

std::string verdicts_table(const std::vector<Judgement>& judgements) {
  Table table({"rule", "verdict", "value", "bound", "certainty"});
  for (const Judgement& judgement : judgements) {
    table.add({judgement.rule.id, std::string(to_text(judgement.verdict)), measured_text(judgement),
               bound_text(judgement.rule, digits_of(judgement)), certainty_text(judgement.rule.certainty)});
  }
  std::string text = table.text();
  for (const std::string& line : open_questions(judgements)) {
    text += "\n  ";
    for (const char letter : line) text += letter == '\n' ? std::string("\n  ") : std::string(1, letter);
  }
  return text + (text.ends_with('\n') ? "" : "\n");
}

std::string shop_table(const std::vector<ShopCheck>& checks) {
  Table table({"rule of the shop", "verdict", "value", "bound", "certainty", ""});
  for (const ShopCheck& check : checks) {
    table.add({check.rule, std::string(to_text(check.verdict)), check.value, check.bound, check.certainty,
               check.where});
  }
  return table.text();
}

std::string rule_text(const Rule& rule) {
  std::string text = rule.sentence + "\n" + std::string(rule_quantity(rule.quantity)->label) + " " +
                     bound_text(rule) + (rule.advice ? ", advice" : "");
  for (const RuleCondition& condition : rule.when) {
    Rule as_rule;
    as_rule.quantity = condition.quantity;
    as_rule.bound = condition.range;
    text += "\nwhere " + std::string(rule_quantity(condition.quantity)->label) + " " + bound_text(as_rule);
  }
  return "  " + emphasised(rule.id, Emphasis::heading) + "\n" + labelled("", text) +
         labelled("", rule.source + " [" + std::string(word(rule.certainty)) + "]");
}

std::string quantities_table() {
  Table table({"quantity", "unit", "of", "meaning", ""});
  for (const RuleQuantity& quantity : rule_quantities()) {
    table.add({std::string(quantity.key), std::string(unit_for_people(quantity.dimension)),
               quantity.subject == RuleSubject::track ? "track" : "fabrication",
               std::string(quantity.label)});
  }
  return table.text();
}

}  // namespace glissade::app
