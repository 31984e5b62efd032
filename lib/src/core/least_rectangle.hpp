#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade::core {

/// @return corners of the least convex polygon round points, counter-clockwise
[[nodiscard]] std::vector<Vec2> hull_of(std::vector<Vec2> points);

/// @return the angle by which to turn points so that the rectangle of least area round them lies along the axes, its longer
///         side level [rad]
[[nodiscard]] double lying_angle(const std::vector<Vec2>& points);

/// @param outline  closed
/// @return length and width of the least rectangle found round it, the longer one as x: what it is cut from; along its own axes where
///         turning it gains less than a thousandth of the area [m]
[[nodiscard]] Vec2 least_size(const ArcPath& outline);

}  // namespace glissade::core
