#pragma once

#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade::parts {

/// @param ground  (x, height) from left to right; one point: level
/// @return its height at x; beyond its ends that of the end
[[nodiscard]] double ground_at(const std::vector<Vec2>& ground, double x);
/// @return the highest of it between two places
[[nodiscard]] double highest_ground(const std::vector<Vec2>& ground, double from, double to);

}  // namespace glissade::parts
