#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/bodies/bores.hpp"

#include <vector>

namespace glissade::parts {

/// Openings of plates that follow a path.

/// @return the section of what a window takes out of its plate, from its lower edge on the face on
/// @param line  of its piece (first_edge())
[[nodiscard]] std::vector<Vec2> section_of(const SweptWindow& window, const BoreLine& line);
/// @return the distance of a place on the plate's face from a window, negative in it
/// @param place  (along the path, along the first edge)
[[nodiscard]] double beside(const SweptWindow& window, Vec2 place);
/// @return points of the plate just beside the edges of its windows
/// @param inset  of the points from the faces [m]
[[nodiscard]] std::vector<Vec3> points_beside(const SweptBody& body, double inset);

}  // namespace glissade::parts
