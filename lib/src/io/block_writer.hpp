#pragma once

#include "glissade/io/atomic_file.hpp"

#include <cstddef>
#include <future>
#include <vector>

namespace glissade {

/// Writes one block in the background while the next is filled: formatting and copying to the system take
/// about the same time each. The bytes and their order do not depend on it.
class BlockWriter {
 public:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 20U;

  explicit BlockWriter(AtomicFile& file);
  ~BlockWriter() = default;
  BlockWriter(const BlockWriter&) = delete;
  BlockWriter& operator=(const BlockWriter&) = delete;

  /// @return the block to fill, kBlockBytes long, zeros at first
  [[nodiscard]] char* block() { return filling_.data(); }

  /// Starts to write the first `used` bytes of the block; block() is another one afterwards.
  /// @throws FileError as AtomicFile, for this block or the one before
  void next(std::size_t used);

  /// Writes the first `used` bytes of the block and waits for everything.
  /// @throws FileError as AtomicFile
  void finish(std::size_t used);

 private:
  void wait();

  AtomicFile& file_;
  std::vector<char> filling_;
  std::vector<char> leaving_;
  std::future<void> writing_;  // last: waits for the thread before the blocks go
};

}  // namespace glissade
