#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/parts/shop_part.hpp"

#include <array>
#include <vector>

namespace glissade::parts {

/// Outlines that frames are set round, seen against the track.
struct FrameOpening {
  std::vector<Vec2> outside;  ///< convex, to its left; x across, y up
  bool ring = false;          ///< closed all round
};

/// The facets of every piece of a part as it lies in the assembly.
struct PlacedFacets {
  std::vector<std::array<Vec3, 3>> facets;
  Vec3 low;  ///< of the box round them
  Vec3 high;
};
/// @return to 10 um
[[nodiscard]] PlacedFacets placed_facets(const ShopPart& part);

/// How far a piece stands out of an opening within a frame's thickness: near a vertical start plates begin and bend so soon
/// behind the frame that they leave the section's own outline.
/// @param place      of the frame: x across, y up, z along the track from its one face to the other
/// @param thickness  of the frame [m]
/// @param reach      what is farther outside than this is on another stretch of the track [m]
/// @return 0 or more [m], to 10 um
[[nodiscard]] double standing_out(const PlacedFacets& part, const FrameOpening& opening, const Frame& place,
                                  double thickness, double reach);

}  // namespace glissade::parts
