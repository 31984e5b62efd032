#pragma once

#include "glissade/core/quantity.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace glissade::design_file {

/// How many items a list may have.
struct ItemCounts {
  std::vector<std::size_t> exactly{};  ///< one of these; none: as many as one likes, from `least` on
  std::size_t least = 0;
};

/// What a reading asked of one place of a design file.
struct Noted {
  std::vector<Dimension> quantities;
  std::vector<std::string> words;         ///< that it may be
  bool text = false;                      ///< any text
  bool flag = false;                      ///< true or false
  bool list = false;                      ///< a list; its items have places of their own
  ItemCounts items;                       ///< of the list
  bool map = false;                       ///< a group of keys
  std::vector<std::string> keys;          ///< of the group, in their order
  std::map<std::string, bool> is_needed;  ///< whether the group must have the key
};

/// Everything that a reading asked for, by key path: with it the reader describes the files that it reads.
class Notes {
 public:
  void quantity(const std::string& path, Dimension dimension);
  void word(const std::string& path, std::string_view word);
  void text(const std::string& path) { places_[path].text = true; }
  void flag(const std::string& path) { places_[path].flag = true; }
  void list(const std::string& path, const ItemCounts& counts);
  void map(const std::string& path) { places_[path].map = true; }
  /// Asking for a key once without need makes it one that may be left out.
  void key(const std::string& path, std::string_view key, bool needed);

  [[nodiscard]] const std::map<std::string, Noted>& places() const { return places_; }
  /// @return what was asked of a place; nothing if the reading did not come there
  [[nodiscard]] Noted at(const std::string& path) const;

 private:
  std::map<std::string, Noted> places_;
};

}  // namespace glissade::design_file
