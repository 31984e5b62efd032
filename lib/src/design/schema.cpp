// The reader run over trees that are grown key by key, each value in every shape and with every word that the
// reader asks about: what it asks for is the schema.

#include "glissade/design/schema.hpp"

#include "glissade/core/quantity.hpp"

#include "design/findings.hpp"
#include "design/notes.hpp"
#include "design/read_tree.hpp"
#include "design/yaml_tree.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace glissade {
namespace design_file {
namespace {

using Json = nlohmann::ordered_json;
using Path = std::vector<std::string>;

std::string joined(const Path& path) {
  std::string text;
  for (const std::string& part : path) text += (text.empty() ? "" : ".") + part;
  return text;
}

Path child(Path path, const std::string& part) {
  path.push_back(part);
  return path;
}

Node scalar(std::string text) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.scalar = std::move(text);
  return node;
}

Node group() {
  Node node;
  node.kind = Node::Kind::map;
  return node;
}

/// A list of two values that are not known: points are pairs.
Node pair() {
  Node node;
  node.kind = Node::Kind::sequence;
  node.items = {scalar("?"), scalar("?")};
  return node;
}

/// Text for use in a regular expression as it stands.
std::string literal(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    if (std::string_view("^$.*+?()[]{}|/\\").find(letter) != std::string_view::npos) result += '\\';
    result += letter;
  }
  return result;
}

Json quantity_schema(Dimension dimension) {
  const std::string number = R"(^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?\s*)";
  std::string units;
  std::string listed;
  for (const UnitName& unit : units_of(dimension)) {
    units += (units.empty() ? "" : "|") + literal(unit.text);
    if (unit.listed) listed += (listed.empty() ? "" : ", ") + std::string(unit.text);
  }
  const bool plain = dimension == Dimension::number;
  Json schema;
  schema["type"] = plain ? Json::array({"number", "string"}) : Json("string");
  schema["pattern"] = number + "(" + units + ")" + (plain ? "?" : "") + R"(\s*$)";
  schema["description"] = plain ? "a plain number, or one with %" : "a number with its unit: " + listed;
  return schema;
}

/// A word; one that some YAML takes for a number or, as the "off" of a mesh file, for a truth value is that, too.
Json word_schema(const std::vector<std::string>& words) {
  Json values = Json::array();
  for (const std::string& word : words) {
    values.push_back(word);
    if (word.find_first_not_of("0123456789") == std::string::npos) values.push_back(std::stoi(word));
    if (word == "off" || word == "no") values.push_back(false);
  }
  return values.size() == 1 ? Json{{"const", values[0]}} : Json{{"enum", values}};
}

/// @return one schema for each length that is asked for
std::vector<Json> list_schemas(const Json& items, const ItemCounts& counts) {
  const Json any = {{"type", "array"}, {"items", items}};
  if (counts.exactly.empty()) {
    Json schema = any;
    if (counts.least > 0) schema["minItems"] = counts.least;
    return {schema};
  }
  std::vector<Json> schemas;
  for (const std::size_t count : counts.exactly) {
    schemas.push_back(any);
    schemas.back()["minItems"] = count;
    schemas.back()["maxItems"] = count;
  }
  return schemas;
}

Json one_of(std::vector<Json> alternatives) {
  if (alternatives.empty()) return Json::object();
  if (alternatives.size() == 1) return std::move(alternatives.front());
  Json schema;
  schema["anyOf"] = std::move(alternatives);
  return schema;
}

class Describer {
 public:
  Json describe() {
    // Once to learn which keys some other part of the file makes superfluous.
    static_cast<void>(describe({}));
    learn_needs();
    needs_are_known_ = true;
    return describe({});
  }

 private:
  /// Reads every group of the file beside every word that a key of another may be.
  void learn_needs() {
    put({}, group());
    const std::vector<std::string> keys = read().at("").keys;
    const std::map<Path, std::vector<std::string>> all_words = words_;
    for (const auto& [path, words] : all_words) {
      if (path.size() != 2) continue;
      for (const std::string& word : words) {
        put({}, group());
        for (const std::string& key : keys) put({key}, group());
        put(path, scalar(word));
        static_cast<void>(read());
      }
    }
  }

  /// @return the schema of whatever may stand at a place whose parents stand
  Json describe(const Path& path) {
    std::vector<Json> alternatives;
    put(path, scalar("?"));
    const Noted value = read().at(joined(path));
    for (const Dimension dimension : value.quantities) alternatives.push_back(quantity_schema(dimension));
    if (!value.words.empty()) alternatives.push_back(word_schema(value.words));
    if (value.text && value.words.empty()) {
      alternatives.push_back({{"type", Json::array({"string", "number", "boolean"})}});
    }
    if (value.flag) alternatives.push_back({{"type", "boolean"}});
    put(path, pair());
    if (const Noted list = read().at(joined(path)); list.list) {
      for (Json& schema : list_schemas(describe(child(path, "0")), list.items))
        alternatives.push_back(std::move(schema));
    }
    put(path, group());
    if (read().at(joined(path)).map) {
      for (Json& schema : group_schemas(path)) alternatives.push_back(std::move(schema));
    }
    return one_of(std::move(alternatives));
  }

  /// @return one schema for each kind of group that may stand there: those whose keys hang on a word in it
  std::vector<Json> group_schemas(const Path& path) {
    put(path, group());
    const std::vector<std::string> keys = read().at(joined(path)).keys;
    for (const std::string& key : keys) {
      put(path, group());
      put(child(path, key), scalar("?"));
      const std::vector<std::string> words = read().at(joined(child(path, key))).words;
      if (!words.empty()) words_[child(path, key)] = words;
      std::vector<std::vector<std::string>> keys_by_word;
      for (const std::string& word : words) {
        put(child(path, key), scalar(word));
        keys_by_word.push_back(read().at(joined(path)).keys);
      }
      const bool all_alike = std::all_of(keys_by_word.begin(), keys_by_word.end(),
                                         [&](const auto& some) { return some == keys; });
      if (all_alike) continue;
      std::vector<Json> schemas;
      for (const std::string& word : words) schemas.push_back(group_schema(path, {{key, word}}));
      return schemas;
    }
    return {group_schema(path, {})};
  }

  /// @param kind  the key and the word that make this kind of group; none where there is one kind only
  Json group_schema(const Path& path, const std::vector<std::pair<std::string, std::string>>& kind) {
    const auto stand = [&] {
      put(path, group());
      for (const auto& [key, word] : kind) put(child(path, key), scalar(word));
    };
    stand();
    std::map<std::string, bool> needed;
    const Noted group = note_needs(path, needed);
    Json properties = Json::object();
    std::vector<std::string> keys = group.keys;
    std::map<std::string, std::string> asked_beside;  // a key that is asked for only where another stands
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::string key = keys[i];
      if (!kind.empty() && kind.front().first == key) {
        properties[key] = word_schema({kind.front().second});
        continue;
      }
      if (asked_beside.contains(key)) put(child(path, asked_beside[key]), scalar("?"));
      properties[key] = describe(child(path, key));
      put(child(path, key), scalar("?"));
      for (const std::string& other : note_needs(path, needed).keys) {
        if (std::find(keys.begin(), keys.end(), other) != keys.end()) continue;
        keys.push_back(other);
        asked_beside[other] = key;
      }
      stand();
    }
    Json required = Json::array();
    for (const std::string& key : keys) {
      const bool elsewhere_too =
          !kind.empty() || !needs_are_known_ || is_always_needed_[joined(child(path, key))];
      if (needed[key] && elsewhere_too) required.push_back(key);
    }
    Json schema;
    schema["type"] = "object";
    schema["properties"] = std::move(properties);
    if (!required.empty()) schema["required"] = std::move(required);
    schema["additionalProperties"] = false;
    return schema;
  }

  /// Reads, and keeps as needed what was needed in every reading of the group so far.
  Noted note_needs(const Path& path, std::map<std::string, bool>& needed) {
    Noted group = read().at(joined(path));
    for (const auto& [key, is_needed] : group.is_needed) {
      const auto [known, fresh] = needed.emplace(key, is_needed);
      known->second = known->second && is_needed;
    }
    return group;
  }

  Notes read() {
    Notes notes;
    const std::vector<Override> none;
    Findings findings("", none);
    findings.keep(notes);
    static_cast<void>(read_tree(root_, "", findings));
    for (const auto& [path, noted] : notes.places()) {
      for (const auto& [key, is_needed] : noted.is_needed) {
        const std::string whole = path.empty() ? key : path + "." + key;
        const auto [known, fresh] = is_always_needed_.emplace(whole, is_needed);
        known->second = known->second && is_needed;
      }
    }
    return notes;
  }

  /// Sets a value whose parents stand.
  void put(const Path& path, Node value) {
    Node* node = &root_;
    for (const std::string& part : path) {
      if (node->kind == Node::Kind::sequence) {
        node = &node->items[static_cast<std::size_t>(std::stoi(part))];
        continue;
      }
      const auto found = std::find_if(node->entries.begin(), node->entries.end(),
                                      [&](const Entry& entry) { return entry.key == part; });
      node = found != node->entries.end() ? &found->value
                                          : &node->entries.emplace_back(Entry{part, {}, {}}).value;
    }
    *node = std::move(value);
  }

  Node root_ = group();
  std::map<Path, std::vector<std::string>> words_;  ///< that a value may be
  bool needs_are_known_ = false;
  std::map<std::string, bool> is_always_needed_;  ///< by the key path, over all readings
};

}  // namespace
}  // namespace design_file

std::string design_schema() {
  design_file::Json schema;
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "Design file of Glissade, version 1";
  schema.update(design_file::Describer().describe());
  return schema.dump(2) + "\n";
}

}  // namespace glissade
