#include "design/read_rules.hpp"

#include "glissade/core/nearest_word.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/words.hpp"
#include "glissade/design/rule_sets.hpp"
#include "glissade/trades/rules.hpp"

#include "data/shipped_data.hpp"
#include "design/read_text.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <utility>

namespace glissade {
namespace design_file {
namespace {

/// What rules of a group may speak of; none: of anything, as those of a file that may be used anywhere.
using Subject = std::optional<RuleSubject>;

std::string_view example_rule(const Subject& subject) {
  if (subject == RuleSubject::workshop)
    return "{id: own.mass, sentence: ..., quantity: part_mass, highest: 25 kg, source: ...}";
  return "{id: own.exit, sentence: ..., quantity: exit_speed, highest: 9 m/s, source: ...}";
}

std::string_view example_condition(const Subject& subject) {
  return subject == RuleSubject::workshop ? "{quantity: part_thickness, highest: 3 mm}"
                                          : "{quantity: hill_size, lowest: 110 m}";
}

std::string_view example_quantity(const Subject& subject) {
  return subject == RuleSubject::workshop ? "quantity: part_mass" : "quantity: steepest_slope_angle";
}

const std::vector<std::pair<std::string_view, Certainty>>& certainty_words() {
  static const std::vector<std::pair<std::string_view, Certainty>> words = [] {
    std::vector<std::pair<std::string_view, Certainty>> all;
    for (const Certainty certainty : certainties()) all.emplace_back(word(certainty), certainty);
    return all;
  }();
  return words;
}

std::string needed_text(MapReader& map, std::string_view key, std::string_view example, Findings& findings) {
  const auto value = map.need(key, example);
  return value ? as_text(*value, findings).value_or("") : std::string();
}

/// Why a quantity is of no use where it stands; none where it is.
std::optional<Issue> misplaced(const RuleQuantity& quantity, const Subject& subject) {
  if (!subject || *subject == quantity.subject) return {};
  const bool of_track = quantity.subject == RuleSubject::track;
  return Issue{"", "quantity: " + shown(quantity.key) + " is of " + (of_track ? "tracks" : "workshops"),
               of_track ? "Rules of a workshop judge the parts, not the track."
                        : "Rules of a track judge its shape and its ride, not the parts that are made of it.",
               of_track ? "the rule below rules:" : "the rule below fabrication: {rules: {own: ...}}"};
}

/// The keys of the quantities that rules of a subject may speak of.
std::vector<std::string_view> quantity_keys(const Subject& subject) {
  std::vector<std::string_view> keys;
  for (const RuleQuantity& quantity : rule_quantities()) {
    if (!misplaced(quantity, subject)) keys.push_back(quantity.key);
  }
  return keys;
}

/// A quantity by its key, or a finding that names the nearest.
const RuleQuantity* read_quantity_key(MapReader& map, const Subject& subject, Findings& findings) {
  const auto value = map.need("quantity", example_quantity(subject));
  const auto key = value ? as_text(*value, findings) : std::nullopt;
  const std::vector<std::string_view> keys = quantity_keys(subject);
  if (Notes* const notes = findings.notes(); notes != nullptr && value) {
    for (const std::string_view one : keys) notes->word(value->key_path, one);
  }
  if (!key) return nullptr;
  if (const RuleQuantity* const quantity = rule_quantity(*key)) {
    if (auto issue = misplaced(*quantity, subject))
      findings.add(value->node->at, value->key_path, *std::move(issue));
    return quantity;
  }
  const std::string_view near = nearest_word(*key, keys);
  findings.add(value->node->at, value->key_path,
               {"", "quantity: " + shown(*key) + " is not known",
                "Rules bound the quantities that 'glissade rules --quantities' lists.",
                near.empty() ? "glissade rules --quantities" : std::string(near)});
  return nullptr;
}

/// `lowest` and `highest` of a map, at least one of them.
Range read_bound(MapReader& map, const Value& value, const RuleQuantity* quantity, Findings& findings) {
  Range bound;
  if (quantity == nullptr) {
    // What unit belongs to them is not known.
    for (const char* const key : {"lowest", "highest"}) {
      if (const auto text = map.find(key)) static_cast<void>(as_text(*text, findings));
    }
    return bound;
  }
  bound.lowest = map.quantity("lowest", quantity->dimension);
  bound.highest = map.quantity("highest", quantity->dimension);
  if (!map.has("lowest") && !map.has("highest")) {
    findings.add(findings.position(value.key_path), value.key_path,
                 {"", value.key + " has neither lowest nor highest", "A rule bounds its quantity.",
                  "highest: " + quantity_text(1.0, quantity->dimension)});
  }
  if (bound.lowest && bound.highest && *bound.lowest > *bound.highest) {
    findings.add(findings.position(map.path_of("lowest")), map.path_of("lowest"),
                 {"",
                  "lowest: " + quantity_text(*bound.lowest, quantity->dimension) + " is above highest, " +
                      quantity_text(*bound.highest, quantity->dimension),
                  "Nothing keeps both.", "the two exchanged"});
  }
  return bound;
}

RuleCondition read_condition(const Value& value, const Subject& subject, Findings& findings) {
  MapReader map(value, "A condition", example_condition(subject), findings);
  map.expect({"quantity", "lowest", "highest"});
  RuleCondition condition;
  const RuleQuantity* const quantity = read_quantity_key(map, subject, findings);
  if (quantity != nullptr) condition.quantity = quantity->key;
  condition.range = read_bound(map, value, quantity, findings);
  map.refuse_unknown_keys();
  return condition;
}

Rule read_rule(const Value& value, const Subject& subject, Findings& findings) {
  MapReader map(value, "A rule", example_rule(subject), findings);
  map.expect({"id", "sentence", "quantity", "lowest", "highest", "advice", "when", "source", "certainty"});
  Rule rule;
  rule.id = needed_text(map, "id", "id: own.exit-speed", findings);
  rule.sentence = needed_text(map, "sentence", "sentence: what the rule asks, in one sentence", findings);
  const RuleQuantity* const quantity = read_quantity_key(map, subject, findings);
  if (quantity != nullptr) rule.quantity = quantity->key;
  rule.bound = read_bound(map, value, quantity, findings);
  if (const auto advice = map.find("advice")) rule.advice = as_flag(*advice, findings).value_or(false);
  if (const auto when = map.find("when")) {
    for (const Value& item : as_list(*when, "[" + std::string(example_condition(subject)) + "]", findings)) {
      rule.when.push_back(read_condition(item, subject, findings));
    }
  }
  rule.source = needed_text(map, "source", "source: document, clause", findings);
  if (const auto certainty = map.find("certainty")) {
    rule.certainty = map.choice(*certainty, certainty_words()).value_or(Certainty::own);
  }
  map.refuse_unknown_keys();
  return rule;
}

std::vector<Rule> read_rule_list(const Value& list, const Subject& subject, Findings& findings) {
  std::vector<Rule> rules;
  std::set<std::string> ids;
  for (const Value& item : as_list(list, "[" + std::string(example_rule(subject)) + "]", findings)) {
    rules.push_back(read_rule(item, subject, findings));
    const std::string& id = rules.back().id;
    if (id.empty() || ids.insert(id).second) continue;
    findings.add(
        item.node->at, item.key_path,
        {"", "id: " + shown(id) + " is given twice", "Verdicts are told apart by it.", "another id"});
  }
  return rules;
}

RuleSet read_set(const Node& root, Findings& findings) {
  RuleSet set;
  findings.set_position("", root.at);
  MapReader top({&root, "", ""}, "A file of rules", "glissade_rules: 1 as its first line", findings);
  top.expect({"glissade_rules", "name", "title", "rules"});
  const std::string version =
      needed_text(top, "glissade_rules", "glissade_rules: 1 as the first line", findings);
  if (!version.empty() && version != "1") {
    findings.add(findings.position("glissade_rules"), "glissade_rules",
                 {"", "glissade_rules: " + shown(version) + " is not a version that this program reads",
                  "It reads version 1.", "glissade_rules: 1"});
  }
  set.name = needed_text(top, "name", "name: our-rules", findings);
  if (const auto title = top.find("title")) set.title = as_text(*title, findings).value_or("");
  if (const auto list = top.need("rules", "rules:")) set.rules = read_rule_list(*list, {}, findings);
  top.refuse_unknown_keys();
  return set;
}

/// A set by its name or file; a problem of its file is one of the design's, at the place that names it.
const RuleSet* shipped(std::string_view name) {
  for (const RuleSet& set : shipped_rule_sets()) {
    if (set.name == name) return &set;
  }
  return nullptr;
}

/// @return the first rule whose quantity is of no use to rules of a subject; null if there is none
const Rule* misplaced_rule(const std::vector<Rule>& rules, RuleSubject subject) {
  for (const Rule& rule : rules) {
    if (misplaced(*rule_quantity(rule.quantity), subject)) return &rule;
  }
  return nullptr;
}

/// The rules of a set, or none and a finding where it is not of the subject.
std::vector<Rule> fitting_rules(const std::vector<Rule>& rules, const Value& value, RuleSubject subject,
                                Findings& findings) {
  const Rule* const stranger = misplaced_rule(rules, subject);
  if (stranger == nullptr) return rules;
  Issue issue = *misplaced(*rule_quantity(stranger->quantity), subject);
  issue.what = value.key + ": its rule " + shown(stranger->id) + " is not of this place, " + issue.what;
  issue.hint = subject == RuleSubject::track ? "the set below fabrication: {rules: {sets: ...}}"
                                             : "the set below rules: {sets: ...}";
  findings.add(value.node->at, value.key_path, std::move(issue));
  return {};
}

std::vector<Rule> rules_of_set(const Value& value, const std::string& name, RuleSubject subject,
                               const std::filesystem::path& folder, Findings& findings) {
  if (!is_rule_file(name)) {
    if (const RuleSet* const set = shipped(name)) return fitting_rules(set->rules, value, subject, findings);
    std::vector<std::string_view> names;
    for (const RuleSet& set : shipped_rule_sets()) names.push_back(set.name);
    findings.add(value.node->at, value.key_path,
                 {"", value.key + ": there is no set of rules named " + shown(name),
                  "There are " + listed(names) + "; a file of one's own ends in .yaml.",
                  std::string(nearest_word(name, names))});
    return {};
  }
  findings.add_data_file({folder / name, value.key_path});
  try {
    return fitting_rules(read_rule_set(folder / name).rules, value, subject, findings);
  } catch (const Error& error) {
    const bool unreadable = dynamic_cast<const FileError*>(&error) != nullptr;
    for (const Issue& issue : error.issues()) {
      Issue here{"", "in " + issue.where + ": " + issue.what, issue.why, issue.hint};
      if (unreadable) {
        findings.add_file(value.node->at, value.key_path, std::move(here));
      } else {
        findings.add(value.node->at, value.key_path, std::move(here));
      }
    }
    return {};
  }
}

void replace_or_add(std::vector<Rule>& rules, const Rule& rule) {
  const auto same =
      std::find_if(rules.begin(), rules.end(), [&](const Rule& one) { return one.id == rule.id; });
  if (same == rules.end()) {
    rules.push_back(rule);
  } else {
    *same = rule;
  }
}

/// @param all_known  without, an id may be that of a rule that is not known here
void leave_out(const Value& list, RulesDesign& rules, bool all_known, Findings& findings) {
  const std::string example = rules.in_force.empty() ? "fis.in-run.load" : rules.in_force.front().id;
  for (const Value& item : as_list(list, "[" + example + "]", findings)) {
    const std::string id = as_text(item, findings).value_or("");
    if (id.empty()) continue;
    rules.left_out.push_back(id);
    const auto left = std::erase_if(rules.in_force, [&](const Rule& rule) { return rule.id == id; });
    if (left != 0 || !all_known) continue;
    std::vector<std::string_view> ids;
    for (const Rule& rule : rules.in_force) ids.push_back(rule.id);
    findings.add(item.node->at, item.key_path,
                 {"", item.key + ": no rule of this design has the id " + shown(id),
                  "'glissade rules' lists all of them.", std::string(nearest_word(id, ids))});
  }
}

}  // namespace

bool is_rule_file(std::string_view name) {
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

RulesDesign suggested_rules(const std::vector<std::string>& suggested) {
  RulesDesign rules;
  for (const std::string& name : suggested) {
    for (const Rule& rule : shipped(name)->rules) replace_or_add(rules.in_force, rule);
  }
  return rules;
}

RulesDesign read_rule_group(const Value& value, const std::optional<std::vector<std::string>>& suggested,
                            RuleSubject subject, const std::filesystem::path& folder, Findings& findings) {
  const std::string set = subject == RuleSubject::workshop ? "[shop-plate]" : "[fis-in-run]";
  MapReader map(value, "A group of rules", "{sets: " + set + "}", findings);
  map.expect({"sets", "own", "leave_out"});
  RulesDesign rules;
  const auto add = [&](const std::vector<Rule>& more) {
    for (const Rule& rule : more) replace_or_add(rules.in_force, rule);
  };
  if (const auto sets = map.find("sets")) {
    rules.sets.emplace();
    for (const Value& item : as_list(*sets, set, findings)) {
      const std::string name = as_text(item, findings).value_or("");
      if (name.empty()) continue;
      rules.sets->push_back(name);
      add(rules_of_set(item, name, subject, folder, findings));
    }
  } else if (suggested) {
    add(suggested_rules(*suggested).in_force);
  }
  if (const auto own = map.find("own")) {
    rules.own = read_rule_list(*own, subject, findings);
    add(rules.own);
  }
  if (const auto list = map.find("leave_out"))
    leave_out(*list, rules, suggested.has_value() || rules.sets.has_value(), findings);
  map.refuse_unknown_keys();
  return rules;
}

void read_rules(MapReader& top, Design& design, Findings& findings) {
  const std::vector<std::string> suggested = suggested_rule_sets(design);
  const auto value = top.find("rules");
  if (!value) {
    design.rules = suggested_rules(suggested);
    return;
  }
  const bool known = !findings.spoiled("centerline.kind") && (design.stream || !findings.spoiled("stream"));
  design.rules = read_rule_group(*value, known ? std::optional(suggested) : std::nullopt, RuleSubject::track,
                                 design.file.parent_path(), findings);
}

}  // namespace design_file

std::vector<std::string> suggested_rule_sets(const Design& design) {
  if (design.stream) return {"chute"};
  if (design.centerline.kind != CenterlineKind::in_run) return {};
  const bool is_circle = design.centerline.in_run.transition == InRunTransition::circle;
  return {is_circle ? "fis-in-run-circle" : "fis-in-run"};
}

RuleSet parse_rule_set(std::string_view text, const std::filesystem::path& file) {
  const std::vector<Override> none;
  design_file::Findings findings(file, none);
  design_file::Node root;
  try {
    root = design_file::parse_tree(text);
  } catch (const design_file::SyntaxProblem& problem) {
    Issue issue = problem.issues().front();
    issue.where = findings.where(problem.at());
    throw InputError(std::move(issue));
  }
  RuleSet set = design_file::read_set(root, findings);
  if (!findings.empty()) throw InputError(findings.issues());
  return set;
}

RuleSet read_rule_set(const std::filesystem::path& file) {
  return parse_rule_set(
      design_file::read_text(file, "the file of rules", "glissade rules prints those that there are"), file);
}

const std::vector<RuleSet>& shipped_rule_sets() {
  static const std::vector<RuleSet> sets = [] {
    std::vector<RuleSet> all;
    for (const data::DataFile& file : data::shipped_data("rules")) {
      all.push_back(parse_rule_set(file.text, std::filesystem::path(file.path)));
    }
    return all;
  }();
  return sets;
}

}  // namespace glissade
