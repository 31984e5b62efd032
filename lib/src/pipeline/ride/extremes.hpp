#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/motion/motion.hpp"

#include <functional>
#include <vector>

namespace glissade::pipeline {

/// A highest value and where it is.
struct Extreme {
  double value = 0.0;
  double at = 0.0;  ///< arc length [m]
};

/// Of what a ride tells Motion::highest() knows the greatest value.
/// @param breaks    ascending arc lengths, at least two [m]
/// @param quantity  of an arc length; smooth between them
/// @return its highest value, at a jump that of the higher side
[[nodiscard]] Extreme highest_along(const std::vector<double>& breaks,
                                    const std::function<double(double s)>& quantity);
/// Between the breaks of a centerline.
[[nodiscard]] Extreme highest_along(const Centerline& centerline,
                                    const std::function<double(double s)>& quantity);

/// @return the highest kappa u^2 of a ride [m/s^2]: how much more than its weight's share the body presses
[[nodiscard]] Extreme highest_radial_acceleration(const Motion& motion);

/// @return smallest radius of curvature along a centerline [m]: 0 where the curvature is unbounded at the
///         start, infinity on a straight
[[nodiscard]] double smallest_radius(const Centerline& centerline);

/// @return largest slope angle along a centerline [rad]
[[nodiscard]] Angle steepest_slope_angle(const Centerline& centerline);

}  // namespace glissade::pipeline
