#pragma once

#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade::parts {

/// @param ground  (x, height) from left to right; one point: level
/// @return its height at x; beyond its ends that of the end
[[nodiscard]] double ground_at(const std::vector<Vec2>& ground, double x);

}  // namespace glissade::parts
