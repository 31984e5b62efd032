#pragma once

#include "glissade/io/atomic_file.hpp"

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace glissade {

/// Formats text into a block that goes to the file when full. Numbers are the shortest decimals that read
/// back as the same value, independent of locale.
class TextWriter {
 public:
  explicit TextWriter(AtomicFile& file) : file_(file), block_(kBlockSize) {}

  TextWriter& operator<<(std::string_view text) {
    if (text.size() > kRoom) {
      flush();
      file_.write(text);
      return *this;
    }
    make_room();
    std::memcpy(block_.data() + used_, text.data(), text.size());
    used_ += text.size();
    return *this;
  }

  TextWriter& operator<<(char character) {
    make_room();
    block_[used_++] = character;
    return *this;
  }

  /// @param value  finite; -0 is written as 0
  TextWriter& operator<<(std::floating_point auto value) { return append(value + decltype(value){0}); }
  TextWriter& operator<<(std::unsigned_integral auto value) { return append(value); }

  /// Hands everything to the file; to be called once at the end.
  void flush() {
    file_.write(block_.data(), used_);
    used_ = 0;
  }

 private:
  static constexpr std::size_t kBlockSize = std::size_t{1} << 18U;
  static constexpr std::size_t kRoom = 64;  // no number needs more than 24 characters

  void make_room() {
    if (used_ + kRoom > kBlockSize) flush();
  }

  template <typename Number>
  TextWriter& append(Number value) {
    make_room();
    char* const start = block_.data() + used_;
    used_ += static_cast<std::size_t>(std::to_chars(start, start + kRoom, value).ptr - start);
    return *this;
  }

  AtomicFile& file_;
  std::vector<char> block_;
  std::size_t used_ = 0;
};

}  // namespace glissade
