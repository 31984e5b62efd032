#pragma once

#include "glissade/core/error.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {

/// Where something stands: in the file (line and column from 1, columns in characters), or in an override.
struct Position {
  int line = 0;
  int column = 0;
  int override_index = -1;  ///< >= 0: in that override, not in the file

  friend bool operator==(const Position&, const Position&) = default;
};

struct Entry;

/// One value of a YAML document. Design files use neither anchors, aliases nor tags.
struct Node {
  enum class Kind { null, scalar, sequence, map };

  Kind kind = Kind::null;
  std::string scalar;
  Position at;
  std::vector<Entry> entries;  ///< of a map, in the order of the file; keys may repeat
  std::vector<Node> items;     ///< of a sequence
};

struct Entry {
  std::string key;
  Position key_at;
  Node value;
};

/// What makes a text unreadable as a whole.
class SyntaxProblem : public Error {
 public:
  SyntaxProblem(Position position, Issue issue) : Error(std::move(issue)), at_(position) {}
  [[nodiscard]] Position at() const noexcept { return at_; }

 private:
  Position at_;
};

/// Reads one YAML document of at most kMaxDepth levels and kMaxNodes values.
/// @param text  UTF-8, with or without byte order mark; any bytes are safe
/// @throws SyntaxProblem if the text is not that
[[nodiscard]] Node parse_tree(std::string_view text);

inline constexpr int kMaxDepth = 32;
inline constexpr int kMaxNodes = 50'000;

}  // namespace glissade::design_file
