#pragma once

#include "glissade/centerline/centerline.hpp"

namespace glissade::pipeline {

/// @return smallest radius of curvature along a centerline [m]: 0 where the curvature is unbounded at the
///         start, infinity on a straight
[[nodiscard]] double smallest_radius(const Centerline& centerline);

/// @return largest slope angle along a centerline [rad]
[[nodiscard]] double steepest_slope_angle(const Centerline& centerline);

}  // namespace glissade::pipeline
