#include "design/overrides.hpp"

#include "glissade/core/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace glissade::design_file {
namespace {

/// "a.b[2].c" and "a.b.2.c" are the same path.
std::vector<std::string> parts_of(std::string_view key_path) {
  std::vector<std::string> parts{""};
  for (const char letter : key_path) {
    if (letter == '.' || letter == '[') {
      parts.emplace_back();
    } else if (letter != ']') {
      parts.back() += letter;
    }
  }
  return parts;
}

void move_to(Node& node, Position position) {
  node.at = position;
  for (Node& item : node.items) move_to(item, position);
  for (Entry& entry : node.entries) {
    entry.key_at = position;
    move_to(entry.value, position);
  }
}

Entry* find_entry(Node& map, std::string_view key) {
  const auto found = std::find_if(map.entries.begin(), map.entries.end(),
                                  [&](const Entry& entry) { return entry.key == key; });
  return found == map.entries.end() ? nullptr : &*found;
}

Node* step_into_list(Node& list, const std::string& part) {
  std::size_t index = 0;
  const char* const end = part.data() + part.size();
  const auto [rest, error] = std::from_chars(part.data(), end, index);
  if (error != std::errc{} || rest != end || index >= list.items.size()) return nullptr;
  return &list.items[index];
}

/// @return the child named `part`, added to a map that has none; null if there can be none
Node* step(Node& node, const std::string& part, Position position) {
  if (node.kind == Node::Kind::null) node.kind = Node::Kind::map;
  if (node.kind == Node::Kind::sequence) return step_into_list(node, part);
  if (node.kind != Node::Kind::map || part.empty()) return nullptr;
  if (Entry* entry = find_entry(node, part)) {
    entry->key_at = position;
    return &entry->value;
  }
  node.entries.push_back({part, position, {}});
  return &node.entries.back().value;
}

void drop_alternative(Node& root, const std::vector<std::string>& parts) {
  if (parts.size() != 2 || parts[0] != "body") return;
  constexpr std::array<std::string_view, 3> kFrictions = {"friction_angle", "friction_coefficient",
                                                          "friction"};
  const auto is_friction = [&](std::string_view key) {
    return std::find(kFrictions.begin(), kFrictions.end(), key) != kFrictions.end();
  };
  Entry* const body = find_entry(root, "body");
  if (!is_friction(parts[1]) || body == nullptr) return;
  std::erase_if(body->value.entries, [&](const Entry& entry) {
    return is_friction(entry.key) && entry.key != parts[1] && entry.key_at.override_index < 0;
  });
}

/// Whether a text is a plain scalar of YAML by its letters alone: a number with a unit, as sweeps set by the million.
bool is_plain_number(std::string_view text) {
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  const auto is_plain = [&](char letter) {
    return is_digit(letter) || (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
           std::string_view(" .+-^/").find(letter) != std::string_view::npos;
  };
  const std::size_t first = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  return text.size() > first && is_digit(text[first]) && !text.ends_with(' ') &&
         std::all_of(text.begin(), text.end(), is_plain);
}

std::optional<Node> parse_value(const Override& change, Position position, Findings& findings) {
  if (is_plain_number(change.value)) {
    Node value;
    value.kind = Node::Kind::scalar;
    value.scalar = change.value;
    value.at = position;
    return value;
  }
  try {
    Node value = parse_tree(change.value);
    if (value.kind != Node::Kind::null) {
      move_to(value, position);
      return value;
    }
    findings.add(position, change.key_path,
                 {"", "no value is given", "", "--set " + shown(change.key_path) + "=VALUE"});
  } catch (const SyntaxProblem& problem) {
    findings.add(position, change.key_path, problem.issues().front());
  }
  return {};
}

void apply(Node& root, const Override& change, Position position, Findings& findings) {
  std::optional<Node> value = parse_value(change, position, findings);
  if (!value) return;
  const std::vector<std::string> parts = parts_of(change.key_path);
  drop_alternative(root, parts);
  Node* place = &root;
  std::string passed;
  for (const std::string& part : parts) {
    Node* const next = step(*place, part, position);
    if (next == nullptr) {
      const std::string parent = passed.empty() ? "the design" : passed;
      const std::string what = parent + " has nothing that can be named \"" + shown(part) + "\"";
      findings.add(position, change.key_path,
                   {"", what, "A list has items from 0 on, a single value has no keys.",
                    "a key path such as body.friction_angle or export.0"});
      return;
    }
    passed += (passed.empty() ? "" : ".") + part;
    place = next;
  }
  *place = *std::move(value);
}

}  // namespace

void apply_overrides(Node& root, const std::vector<Override>& overrides, Findings& findings) {
  for (std::size_t index = 0; index < overrides.size(); ++index) {
    const Position position{0, 0, static_cast<int>(index)};
    apply(root, overrides[index], position, findings);
  }
}

}  // namespace glissade::design_file
