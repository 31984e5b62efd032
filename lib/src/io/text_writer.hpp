#pragma once

#include "glissade/io/atomic_file.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace glissade::io {

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

  /// Appends the first `size` characters of a number's text; copies all of it, as a fixed length is quicker.
  void put_number(const std::array<char, kLongestNumber>& text, std::size_t size) {
    std::memcpy(place_, text.data(), text.size());
    place_ += size;
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

/// Numbers of which many come again soon, such as the coordinates of a sweep's rows: the text of the last ones is
/// kept, because copying it costs a fraction of working it out.
class RecurringNumbers {
 public:
  /// Appends what cursor.put(value) would.
  void put(TextCursor& cursor, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    Entry& entry = entries_[(bits * kSpread) >> (64 - kIndexBits)];
    if (entry.size == 0 || entry.bits != bits) {
      TextCursor text(entry.text.data());
      text.put(value);
      entry.bits = bits;
      entry.size = static_cast<std::size_t>(text.place() - entry.text.data());
    }
    cursor.put_number(entry.text, entry.size);
  }

 private:
  static constexpr int kIndexBits = 9;
  static constexpr std::uint64_t kSpread =
      0x9E3779B97F4A7C15;  // Fibonacci hashing: 2^64 over the golden ratio

  struct Entry {
    std::uint64_t bits = 0;
    std::size_t size = 0;  ///< of the text; 0: nothing kept yet
    std::array<char, TextCursor::kLongestNumber> text;
  };

  std::array<Entry, std::size_t{1} << kIndexBits> entries_{};
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

}  // namespace glissade::io
