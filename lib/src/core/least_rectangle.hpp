#pragma once

#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade::core {

/// @return corners of the least convex polygon round points, counter-clockwise
[[nodiscard]] std::vector<Vec2> hull_of(std::vector<Vec2> points);

/// @return the angle by which to turn points so that the rectangle of least area round them lies along the axes, its longer
///         side level [rad]
[[nodiscard]] double lying_angle(const std::vector<Vec2>& points);

}  // namespace glissade::core
