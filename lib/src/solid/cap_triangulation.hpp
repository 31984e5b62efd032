#pragma once

#include "glissade/core/vec.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace glissade::solid {

/// Triangles that fill the region between closed loops of a plane, using exactly the given points.
///
/// Constrained Delaunay: of all triangulations without further points the one whose smallest angle is
/// largest.
/// @param loops  simple, not touching one another; a point is inside where it is inside an odd number of them
/// @return corners as running indices over all loops, in their order; counter-clockwise
/// @throws InternalError if the loops cross or touch
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangulate_loops(
    const std::vector<std::vector<Vec2>>& loops);

}  // namespace glissade::solid
