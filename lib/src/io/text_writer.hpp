#pragma once

#include "glissade/io/atomic_file.hpp"

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace glissade {

/// Appends text to memory that the caller has made room for. Numbers are the shortest decimals that read back
/// as the same value, independent of locale; -0 is written as 0.
class TextCursor {
 public:
  /// Room that any number needs, whatever its type.
  static constexpr std::size_t kLongestNumber = 32;

  explicit TextCursor(char* place) : place_(place) {}

  /// Appends texts, characters and numbers, one after the other.
  template <typename... Parts>
  void put(const Parts&... parts) {
    (append(parts), ...);
  }

  [[nodiscard]] char* place() const { return place_; }

 private:
  void append(std::floating_point auto value) { append_number(value + decltype(value){0}); }
  void append(std::unsigned_integral auto value) { append_number(value); }
  void append(char character) { *place_++ = character; }
  void append(std::string_view text) {
    std::memcpy(place_, text.data(), text.size());
    place_ += text.size();
  }

  template <typename Number>
  void append_number(Number value) {
    place_ = std::to_chars(place_, place_ + kLongestNumber, value).ptr;
  }

  char* place_;
};

/// Text that goes to a file, one piece after the other.
class TextWriter {
 public:
  explicit TextWriter(AtomicFile& file) : file_(file) {}

  /// Appends texts, characters and numbers as TextCursor does.
  template <typename... Parts>
  void put(const Parts&... parts) {
    line_.resize((room_for(parts) + ...));
    TextCursor cursor(line_.data());
    cursor.put(parts...);
    file_.write(line_.data(), static_cast<std::size_t>(cursor.place() - line_.data()));
  }

 private:
  template <typename Number>
  requires std::floating_point<Number> || std::unsigned_integral<Number>
  static constexpr std::size_t room_for(Number /*value*/) { return TextCursor::kLongestNumber; }
  static constexpr std::size_t room_for(char /*character*/) { return 1; }
  static std::size_t room_for(std::string_view text) { return text.size(); }

  AtomicFile& file_;
  std::vector<char> line_;
};

}  // namespace glissade
