#include "design/map_reader.hpp"

#include "glissade/core/nearest_word.hpp"
#include "glissade/core/odd_characters.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/words.hpp"

#include "core/counted.hpp"

#include <algorithm>
#include <variant>

namespace glissade::design_file {
namespace {

std::string_view kind_of(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "empty";
    case Node::Kind::scalar:
      return "a single value";
    case Node::Kind::sequence:
      return "a list";
    case Node::Kind::map:
      return "a group of keys";
  }
  return "";
}

std::string child_path(std::string_view parent, std::string_view key) {
  return parent.empty() ? std::string(key) : std::string(parent).append(".").append(key);
}

void add_wrong_type(const Value& value, std::string_view wanted, std::string_view example, Findings& findings,
                    std::string why = "") {
  const std::string name = value.key.empty() ? "the design" : value.key;
  std::string what = name + " is " + std::string(kind_of(*value.node)) + ", not " + std::string(wanted);
  Issue issue{"", std::move(what), std::move(why), std::string(example)};
  // A colon with an odd blank behind it parts no key from its value.
  const auto odd = odd_character(value.node->scalar);
  if (odd) {
    issue.why = "It reads " + shown(value.node->scalar) + ": there is " + odd->name + " in it.";
    issue.hint = with_plain_characters(value.node->scalar);
  }
  findings.add(value.node->at, value.key_path, std::move(issue));
}

/// The first value in a list or a group that reads as a quantity: whoever wrote one there means it.
std::string quantity_within(const Node& node, Dimension dimension) {
  std::vector<const Node*> values;
  for (const Node& item : node.items) values.push_back(&item);
  for (const Entry& entry : node.entries) values.push_back(&entry.value);
  for (const Node* const one : values) {
    if (one->kind != Node::Kind::scalar) continue;
    if (std::holds_alternative<double>(read_quantity(one->scalar, dimension, ""))) return one->scalar;
  }
  return {};
}

/// What could stand where a quantity is asked for and is none at all.
std::string example_of(const Value& value, Dimension dimension) {
  const std::string within = quantity_within(*value.node, dimension);
  if (!within.empty()) return value.key + ": " + within;
  if (!value.example.empty()) return value.example;
  constexpr double kSome = 1.5;  // taste
  return value.key + ": " + quantity_text(kSome, dimension);
}

void add_no_quantity(const Value& value, Dimension dimension, Findings& findings) {
  // Of no text at all, what is wrong is told with the units that fit.
  const Issue units = std::get<Issue>(read_quantity("", dimension, value.key));
  add_wrong_type(value, "a single value", example_of(value, dimension), findings, units.why);
}

std::string trimmed(const std::string& text) {
  const std::size_t from = std::min(text.find_first_not_of(' '), text.size());
  return text.substr(from, text.find_last_not_of(' ') + 1 - from);
}

}  // namespace

std::optional<double> as_quantity(const Value& value, Dimension dimension, Findings& findings) {
  if (Notes* const notes = findings.notes()) notes->quantity(value.key_path, dimension);
  if (value.node->kind != Node::Kind::scalar) {
    add_no_quantity(value, dimension, findings);
    return {};
  }
  std::variant<double, Issue> reading = read_quantity(value.node->scalar, dimension, value.key);
  if (const double* number = std::get_if<double>(&reading)) return *number;
  findings.add(value.node->at, value.key_path, std::get<Issue>(std::move(reading)));
  return {};
}

bool is_word(const Value& value, std::string_view word, Findings& findings) {
  if (Notes* const notes = findings.notes()) notes->word(value.key_path, word);
  return value.node->kind == Node::Kind::scalar && value.node->scalar == word;
}

std::optional<std::string> as_text(const Value& value, Findings& findings) {
  if (Notes* const notes = findings.notes()) notes->text(value.key_path);
  if (value.node->kind == Node::Kind::scalar) return value.node->scalar;
  add_wrong_type(value, "a text", value.example.empty() ? value.key + ": a text, in quotes" : value.example,
                 findings);
  return {};
}

std::optional<bool> as_flag(const Value& value, Findings& findings) {
  if (Notes* const notes = findings.notes()) notes->flag(value.key_path);
  if (value.node->kind == Node::Kind::scalar) {
    if (value.node->scalar == "true") return true;
    if (value.node->scalar == "false") return false;
  }
  const std::string text =
      value.node->kind == Node::Kind::scalar ? value.key + ": " + shown(value.node->scalar) : value.key;
  findings.add(value.node->at, value.key_path,
               {"", text + " is neither true nor false", "", value.key + ": true"});
  return {};
}

std::vector<Value> as_list(const Value& value, std::string_view example, Findings& findings,
                           const ItemCounts& counts) {
  if (Notes* const notes = findings.notes()) notes->list(value.key_path, counts);
  if (value.node->kind != Node::Kind::sequence) {
    add_wrong_type(value, "a list", example, findings);
    return {};
  }
  std::vector<Value> values;
  for (const Node& item : value.node->items) {
    const std::string index = std::to_string(values.size());
    values.push_back({&item, value.key + "[" + index + "]", child_path(value.key_path, index)});
    findings.set_position(values.back().key_path, item.at);
  }
  return values;
}

namespace {

/// Of a point: what a file has as `{x: 2 m, z: 4 m}`, as start and finish are written, in the form of a point.
std::string pair_like(const Node& node) {
  const bool is_place = node.kind == Node::Kind::map && node.entries.size() == 2 &&
                        node.entries[0].value.kind == Node::Kind::scalar &&
                        node.entries[1].value.kind == Node::Kind::scalar;
  if (!is_place) return "[-200 mm, 250 mm]";
  const bool turned = node.entries[1].key == "x";
  const auto scalar = [&](bool first) { return node.entries[first == turned ? 1 : 0].value.scalar; };
  return "[" + scalar(true) + ", " + scalar(false) + "]";
}

}  // namespace

std::optional<Vec2> as_point(const Value& value, Findings& findings, std::string_view example) {
  const std::vector<Value> numbers = as_list(value, pair_like(*value.node), findings, {.exactly = {2}});
  if (value.node->kind != Node::Kind::sequence) return {};
  if (numbers.size() != 2) {
    findings.add(value.node->at, value.key_path,
                 {"", value.key + " has " + core::counted(numbers.size(), "value") + " instead of 2",
                  "It is a pair.", std::string(example)});
    return {};
  }
  const auto first = as_quantity(numbers[0], Dimension::length, findings);
  const auto second = as_quantity(numbers[1], Dimension::length, findings);
  if (!first || !second) return {};
  return Vec2{*first, *second};
}

std::vector<Vec2> as_points(const Value& value, std::string_view example, Findings& findings,
                            const ItemCounts& counts) {
  std::vector<Vec2> points;
  for (const Value& item : as_list(value, example, findings, counts)) {
    if (const auto point = as_point(item, findings)) points.push_back(*point);
  }
  return points;
}

MapReader::MapReader(const Value& value, std::string_view noun, std::string_view example, Findings& findings)
    : key_path_(value.key_path), noun_(noun), findings_(findings) {
  if (Notes* const notes = findings.notes()) notes->map(value.key_path);
  if (value.node->kind != Node::Kind::map) {
    add_wrong_type(value, "a group of keys", example, findings);
    return;
  }
  node_ = value.node;
  refuse_duplicates();
}

void MapReader::expect(std::initializer_list<std::string_view> keys) {
  expect(std::vector<std::string_view>(keys));
}

void MapReader::expect(const std::vector<std::string_view>& keys) {
  known_ = keys;
  Notes* const notes = findings_.notes();
  for (const std::string_view key : keys) {
    if (notes != nullptr) notes->key(key_path_, key, false);
  }
}

void MapReader::refuse_duplicates() {
  const std::vector<Entry>& entries = node_->entries;
  std::map<std::string_view, Position> seen;
  for (const Entry& entry : entries) {
    const auto [first, is_new] = seen.emplace(entry.key, entry.key_at);
    if (is_new) continue;
    findings_.add(entry.key_at, path_of(entry.key),
                  {"", shown(entry.key) + " is given twice",
                   "It stands already at " + findings_.where(first->second) + ".", "one of the two"});
  }
}

std::string MapReader::path_of(std::string_view key) const {
  return child_path(key_path_, key);
}

bool MapReader::has(std::string_view key) const {
  if (node_ == nullptr) return false;
  return std::any_of(node_->entries.begin(), node_->entries.end(),
                     [&](const Entry& entry) { return entry.key == key; });
}

std::optional<Value> MapReader::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  if (Notes* const notes = findings_.notes()) notes->key(key_path_, key, false);
  if (node_ == nullptr) return {};
  for (const Entry& entry : node_->entries) {
    if (entry.key != key) continue;
    Value value{&entry.value, entry.key, path_of(key)};
    const bool is_inline = entry.value.kind == Node::Kind::scalar;
    findings_.set_position(value.key_path, is_inline ? entry.value.at : entry.key_at);
    if (entry.value.kind != Node::Kind::null) return value;
    findings_.add(entry.key_at, value.key_path,
                  {"", entry.key + " has no value", "", "a value after the colon, or no such key"});
    return {};
  }
  return {};
}

std::optional<Value> MapReader::need(std::string_view key, std::string_view example) {
  if (Notes* const notes = findings_.notes()) notes->key(key_path_, key, true);
  if (readable() && !has(key)) {
    findings_.add(
        findings_.position(key_path_), path_of(key),
        {"", std::string(key) + " is missing", std::string(noun_) + " needs it.", std::string(example)});
    findings_.set_position(path_of(key), findings_.position(key_path_));
  }
  std::optional<Value> value = find(key);
  if (value) value->example = example;
  return value;
}

std::optional<double> MapReader::quantity(std::string_view key, Dimension dimension) {
  const std::optional<Value> value = find(key);
  return value ? as_quantity(*value, dimension, findings_) : std::nullopt;
}

std::optional<double> MapReader::needed_quantity(std::string_view key, Dimension dimension,
                                                 std::string_view example) {
  const std::optional<Value> value = need(key, example);
  return value ? as_quantity(*value, dimension, findings_) : std::nullopt;
}

std::optional<std::size_t> MapReader::choose(const Value& value, const std::vector<std::string_view>& words) {
  if (Notes* const notes = findings_.notes()) {
    for (const std::string_view word : words) notes->word(value.key_path, word);
  }
  const std::string allowed = "It is one of " + listed(words, "or") + ".";
  if (value.node->kind != Node::Kind::scalar) {
    add_wrong_type(value, "a word", value.key + ": " + std::string(words.front()), findings_, allowed);
    return {};
  }
  const std::string* const text = &value.node->scalar;
  const auto found = std::find(words.begin(), words.end(), *text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  const std::string plain = trimmed(with_plain_characters(*text));
  const std::string_view near = nearest_word(plain, words);
  std::string what = value.key + ": " + shown(*text) + " is not known";
  if (const auto odd = odd_character(*text)) what += "; it holds " + odd->name;
  findings_.add(value.node->at, value.key_path,
                {"", std::move(what), allowed, near.empty() ? "one of these words" : std::string(near)});
  return {};
}

bool MapReader::has_misspelt(std::string_view key) const {
  return node_ != nullptr &&
         std::any_of(node_->entries.begin(), node_->entries.end(), [&](const Entry& entry) {
           const bool known = std::find(known_.begin(), known_.end(), entry.key) != known_.end();
           return !known && meant_by(entry.key) == key;
         });
}

std::string_view MapReader::meant_by(const std::string& key) const {
  const std::string_view near = nearest_word(key, known_);
  return near.empty() || has(near) ? std::string_view() : near;
}

Issue MapReader::unknown_key(const std::string& key) const {
  const std::vector<std::string_view>& keys = known_;
  Issue issue{"", "unknown key " + shown(key), std::string(noun_) + " has the keys " + listed(keys) + ".",
              ""};
  if (const auto odd = odd_character(key)) {
    const bool leads = odd->offset == 0;
    issue.what += leads ? ": it begins with " + odd->name : ": it holds " + odd->name;
    issue.hint = trimmed(with_plain_characters(key));
    if (leads) issue.why = "YAML indents with plain blanks, and takes any other for a part of the key.";
    if (leads) issue.hint = "blanks before " + issue.hint;
    return issue;
  }
  for (const auto& [stranger, belongs_to] : strangers_) {
    if (stranger != key) continue;
    issue.hint = std::string(belongs_to);
    return issue;
  }
  const std::string_view near = nearest_word(key, keys);
  issue.hint = near.empty() ? "one of these keys, or none" : std::string(near);
  const bool after_comma = !key.empty() && key.front() >= '0' && key.front() <= '9';
  if (after_comma) issue.hint = "a decimal point, if the comma before it was meant as one";
  return issue;
}

void MapReader::refuse_unknown_keys() {
  if (node_ == nullptr) return;
  for (const Entry& entry : node_->entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    // What hangs on the key that was meant has no problem beside this one: neither that it is missing.
    const std::string_view meant = meant_by(entry.key);
    if (!meant.empty()) findings_.withdraw(path_of(meant));
    findings_.add(entry.key_at, path_of(meant.empty() ? entry.key : meant), unknown_key(entry.key));
  }
}

}  // namespace glissade::design_file
