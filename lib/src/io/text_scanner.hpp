#pragma once

#include "io/byte_source.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace glissade::io {

/// Words and lines of a text file of any size in constant memory.
///
/// Words are parted by white space; lines end with line feed, carriage return or both.
class TextScanner {
 public:
  /// Longer words are never numbers or keywords; word() gives this many characters of them.
  static constexpr std::size_t kLongestWord = 256;

  explicit TextScanner(ByteSource& source);

  /// From here on `comment` starts a comment, up to the end of its line.
  void set_comment(char comment) { comment_ = comment; }

  /// @return the next word, valid until the next call; empty at the end of the file
  [[nodiscard]] std::string_view word();
  /// Goes on after the end of the current line.
  void skip_line();

  /// @return the first bytes, up to `count` (at most 4096), without going on
  [[nodiscard]] std::string_view peek(std::size_t count);
  /// Takes bytes out as they are, e.g. after peek() has shown that the file is not text.
  [[nodiscard]] std::size_t read(char* buffer, std::size_t count);

  /// @return number of the line that the last word stood on, from 1
  [[nodiscard]] std::uint64_t line() const { return line_; }
  /// @return bytes not scanned yet
  [[nodiscard]] std::uint64_t bytes_left() const { return size_ - scanned_ - place_; }

 private:
  [[nodiscard]] bool refill();
  [[nodiscard]] bool at_end() { return place_ == filled_ && !refill(); }
  void skip_blanks();
  void skip_to_line_end();
  void skip_line_break();
  [[nodiscard]] std::string_view take_word();

  ByteSource& source_;
  char comment_ = 0;
  std::vector<char> buffer_;
  std::size_t place_ = 0;
  std::size_t filled_ = 0;
  std::uint64_t size_;
  std::uint64_t scanned_ = 0;  ///< bytes before buffer_
  std::uint64_t line_ = 1;
};

}  // namespace glissade::io
