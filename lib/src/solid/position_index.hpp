#pragma once

#include "glissade/core/vec.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace glissade::solid {

/// Finds equal positions in constant time each: a hash table of indices into an array of positions.
///
/// Equal means equal coordinates; -0 equals 0. Coordinates must be finite. Eight bytes a slot, at most half
/// full.
class PositionIndex {
 public:
  /// @param positions  kept by reference; may grow while the table lives
  /// @param expected   number of distinct positions to make room for; more are welcome
  explicit PositionIndex(const std::vector<Vec3>& positions, std::size_t expected = 0);

  /// @param position  finite
  /// @param index     where `positions` holds it (or will, before the next call)
  /// @return the index entered earlier for an equal position; `index` where there is none, which is entered
  [[nodiscard]] std::uint32_t enter(Vec3 position, std::uint32_t index);

 private:
  struct Slot {
    std::uint32_t tag = 0;
    std::uint32_t index = kFree;
  };
  static constexpr std::uint32_t kFree = UINT32_MAX;

  void grow();

  const std::vector<Vec3>& positions_;
  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

}  // namespace glissade::solid
