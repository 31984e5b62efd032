#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

#include <optional>

namespace glissade {

/// How the curvature of a segment runs between its ends.
enum class SegmentBend {
  clothoid,  ///< linear in arc length: a straight, an arc or a clothoid
  cubic      ///< that of a cubic parabola, which is straight at one end (CubicBend)
};

/// One piece of a `segments` centerline, told by as much as determines it:
///
///   length, curvatures           what is left out of the curvatures is 0
///   to_slope_angle, curvatures   the length follows
///   to_slope_angle, length       an arc
///   to_point                     an arc
///   to_point, to_slope_angle     a clothoid
///   cubic: to_slope_angle and one of the curvatures
struct SegmentDesign {
  std::optional<double> length;              ///< [m]; > 0
  double entry_curvature = 0.0;              ///< [1/m]
  double exit_curvature = 0.0;               ///< [1/m]
  std::optional<Angle> to_slope_angle = {};  ///< slope angle where it ends; -90 to 90 deg
  std::optional<Vec2> to_point = {};         ///< where it ends, (x, z) as the points of limits [m]
  SegmentBend bend = SegmentBend::clothoid;

  friend bool operator==(const SegmentDesign&, const SegmentDesign&) = default;
};

}  // namespace glissade
