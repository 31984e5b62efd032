#include "solid/position_index.hpp"

#include <algorithm>
#include <bit>

namespace glissade::solid {
namespace {

constexpr std::size_t kSmallestTable = 64;

std::uint64_t mixed(std::uint64_t bits) {
  bits ^= bits >> 32U;
  bits *= 0xd6e8feb86659fd93U;
  bits ^= bits >> 32U;
  bits *= 0xd6e8feb86659fd93U;
  bits ^= bits >> 32U;
  return bits;
}

std::uint64_t hash_of(Vec3 position) {
  // Adding +0 turns -0 into +0: equal numbers must have equal bits.
  const auto x = std::bit_cast<std::uint64_t>(position.x + 0.0);
  const auto y = std::bit_cast<std::uint64_t>(position.y + 0.0);
  const auto z = std::bit_cast<std::uint64_t>(position.z + 0.0);
  return mixed(mixed(x * 0x9e3779b97f4a7c15U + y) + z * 0xc2b2ae3d27d4eb4fU);
}

}  // namespace

PositionIndex::PositionIndex(const std::vector<Vec3>& positions, std::size_t expected)
    : positions_(positions), slots_(std::bit_ceil(std::max(kSmallestTable, 2 * expected))) {}

std::uint32_t PositionIndex::enter(Vec3 position, std::uint32_t index) {
  if (2 * used_ >= slots_.size()) grow();
  const std::uint64_t hash = hash_of(position);
  const auto tag = static_cast<std::uint32_t>(hash);
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t place = (hash >> 20U) & mask;; place = (place + 1) & mask) {
    Slot& slot = slots_[place];
    if (slot.index == kFree) {
      slot = {tag, index};
      ++used_;
      return index;
    }
    if (slot.tag == tag && positions_[slot.index] == position) return slot.index;
  }
}

void PositionIndex::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  const std::size_t mask = slots_.size() - 1;
  for (const Slot& slot : old) {
    if (slot.index == kFree) continue;
    std::size_t place = (hash_of(positions_[slot.index]) >> 20U) & mask;
    while (slots_[place].index != kFree) place = (place + 1) & mask;
    slots_[place] = slot;
  }
}

}  // namespace glissade::solid
