#pragma once

#include "glissade/core/quantity.hpp"
#include "glissade/core/vec.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Pieces of a design file that is written back.
namespace glissade::design_file {

/// A group of keys on one line or on several, as it is put together.
class Group {
 public:
  void add(std::string_view key, std::string value) { entries_.emplace_back(key, std::move(value)); }
  void add(std::string_view key, double value, Dimension dimension) {
    add(key, written_quantity(value, dimension));
  }
  void add(std::string_view key, const std::optional<double>& value, Dimension dimension) {
    if (value) add(key, *value, dimension);
  }
  /// Leaves out what reads the same without it.
  void add_unless(double left_out, std::string_view key, double value, Dimension dimension) {
    if (value != left_out) add(key, value, dimension);
  }

  [[nodiscard]] std::string inlined() const {
    std::string text;
    for (const auto& [key, value] : entries_) {
      if (!text.empty()) text += ", ";
      text.append(key).append(": ").append(value);
    }
    return "{" + text + "}";
  }
  [[nodiscard]] std::string lines() const {
    if (entries_.empty()) return " {}\n";
    std::string text = "\n";
    for (const auto& [key, value] : entries_)
      text.append("  ").append(key).append(": ").append(value).append("\n");
    return text;
  }

 private:
  std::vector<std::pair<std::string, std::string>> entries_;
};

/// A text that YAML reads back byte for byte.
[[nodiscard]] std::string in_quotes(std::string_view text);
[[nodiscard]] std::string length(double value);
[[nodiscard]] std::string point(Vec2 at);

template <typename Things, typename Text>
std::string list_of(const Things& things, Text text_of) {
  std::string text;
  for (const auto& thing : things) text += (text.empty() ? "" : ", ") + std::string(text_of(thing));
  return "[" + text + "]";
}

}  // namespace glissade::design_file
