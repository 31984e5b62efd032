#pragma once

#include "parts/plates/plate_joints.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// Floors and walls of a channel that are wider than a strip may be, cut along the track (seams.hpp). One that goes in one piece is
/// its only strip.

/// The floor of a unit, finished, from its left edge to its right one.
/// @param unit   with its holes
/// @param index  from 0, of the unit: seams of units that no frame parts are staggered
[[nodiscard]] std::vector<ShopPart> floor_strips(const Job& job, const Unit& unit, std::size_t index);

/// A strip of the walls of a unit, both sides.
struct WallStrip {
  ShopPart part;
  Span heights;        ///< above the floor line
  PlaneRegion region;  ///< in the plane (x, height) of the track
};
/// @return from the lowest; none of a channel without walls
[[nodiscard]] std::vector<WallStrip> wall_strips(const Job& job, const Unit& unit, std::size_t index);

/// @return how long the seams of a unit are [m]
[[nodiscard]] double seam_length(const Job& job, const Unit& unit, std::size_t index);

/// Seams across the floor of a unit, from its left edge.
[[nodiscard]] std::vector<double> floor_seams(const Job& job, std::size_t index);

}  // namespace glissade::parts
