#pragma once

#include "io/block_writer.hpp"

#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace glissade {

/// Formats text into blocks. Numbers are the shortest decimals that read back as the same value, independent
/// of locale; -0 is written as 0.
class TextWriter {
 public:
  explicit TextWriter(AtomicFile& file) : blocks_(file) {}

  /// Appends texts, characters and numbers, one after the other.
  template <typename... Parts>
  void put(const Parts&... parts) {
    if (used_ + (room_for(parts) + ...) > BlockWriter::kBlockBytes) next_block();
    (append(parts), ...);
  }

  /// Hands everything to the file; to be called once at the end.
  void finish() { blocks_.finish(used_); }

 private:
  static constexpr std::size_t kLongestNumber = 32;

  template <typename Number>
  requires std::floating_point<Number> || std::unsigned_integral<Number>
  static constexpr std::size_t room_for(Number /*value*/) { return kLongestNumber; }
  static constexpr std::size_t room_for(char /*character*/) { return 1; }
  /// Texts come from literals and shortened names: far smaller than a block.
  static std::size_t room_for(std::string_view text) { return text.size(); }

  void append(std::floating_point auto value) { append_number(value + decltype(value){0}); }
  void append(std::unsigned_integral auto value) { append_number(value); }
  void append(char character) { blocks_.block()[used_++] = character; }
  void append(std::string_view text) {
    std::memcpy(blocks_.block() + used_, text.data(), text.size());
    used_ += text.size();
  }

  template <typename Number>
  void append_number(Number value) {
    char* const start = blocks_.block() + used_;
    used_ += static_cast<std::size_t>(std::to_chars(start, start + kLongestNumber, value).ptr - start);
  }

  void next_block() {
    blocks_.next(used_);
    used_ = 0;
  }

  BlockWriter blocks_;
  std::size_t used_ = 0;
};

}  // namespace glissade
