#pragma once

#include "glissade/io/atomic_file.hpp"

#include <cstddef>
#include <functional>
#include <stop_token>

namespace glissade::io {

inline constexpr std::size_t kBytesBeyondBlock = 8;

/// A long row of items that becomes a row of blocks of bytes.
struct BlockPlan {
  std::size_t items = 0;
  std::size_t most_bytes_per_item = 0;
  /// Fills a block with items [first, last) and returns its end; kBytesBeyondBlock after that are its own too,
  /// and what the block held before is undefined. Runs on several threads at once; must depend on its
  /// arguments alone.
  std::function<char*(std::size_t first, std::size_t last, char* block)> format;
};

/// Formats blocks on every core and writes them in their order: while one thread hands its block to the
/// system, which takes about as long as formatting it, the others format. The bytes do not depend on how many
/// threads there are.
/// @throws FileError as AtomicFile, or what `format` throws
/// @throws Interrupted if `stop` asks for it, from one block to the next
void write_in_order(AtomicFile& file, const BlockPlan& plan, const std::stop_token& stop);

/// Splits [0, count) among the cores: `work` gets one [first, last) after the other of a core's share and runs on
/// several threads at once.
/// @throws what `work` throws; where several do, that of the lowest range
/// @throws Interrupted if `stop` asks for it, from one range to the next
void in_ranges(std::size_t count, const std::function<void(std::size_t first, std::size_t last)>& work,
               const std::stop_token& stop);

/// Hands 0 to count - 1 to the cores in their order, each as soon as one is free.
/// @param begin  of each in its order, one at a time
/// @param work   after that, on several threads at once
/// @throws what either throws; where several do, that of the lowest. What has not begun by then does not
void each_in_turn(std::size_t count, const std::function<void(std::size_t)>& begin,
                  const std::function<void(std::size_t)>& work);

}  // namespace glissade::io
