#pragma once

#include "glissade/parts/shop_part.hpp"

#include <vector>

namespace glissade::parts {

/// @return a point of the assembly in the frame of a piece
[[nodiscard]] Vec3 in_own(const Frame& place, Vec3 point);

/// A piece as it lies in the assembly, with the box round its edges in its own frame.
struct PlacedPiece {
  const ShopPart* part = nullptr;
  Frame place;
  Vec3 low;
  Vec3 high;

  /// @return whether a point of its own frame lies within the box, or nearer to it than `room` along each axis
  [[nodiscard]] bool near(Vec3 own, double room) const;
};

/// @return in the order of the parts
[[nodiscard]] std::vector<PlacedPiece> placed_pieces(const Workshop& workshop);

}  // namespace glissade::parts
