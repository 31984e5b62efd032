#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/body_moments.hpp"
#include "parts/bores.hpp"

#include <vector>

namespace glissade::parts {

/// Openings and holes of tubes.

/// @return the holes of a tube, from its inside outwards
[[nodiscard]] std::vector<Bore> bores_of(const TubeGore& gore);
/// @return what a window takes out of its tube
[[nodiscard]] BodyMoments moments_of(const TubeWindow& window, const TubeGore& gore);
/// @return the distance of a place from a window, square to the edges that it has on the cylinder through that place; negative in it
[[nodiscard]] double beside(const TubeWindow& window, Vec3 place);
/// @return points of the tube just beside the edges of its windows
/// @param inset  of the points from the faces [m]
[[nodiscard]] std::vector<Vec3> points_beside(const TubeGore& gore, double inset);

}  // namespace glissade::parts
