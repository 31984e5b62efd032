#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

namespace glissade {

/// Puts the vertical plane of a centerline into space.
///
/// Frame: x, y level, z up. "Across" counts to the left of a body that looks towards the finish.
class Placement {
 public:
  /// In the x-z plane with the start at the origin.
  Placement() = default;

  /// @param start    position of the start [m]
  /// @param azimuth  direction of the run, counter-clockwise from +x seen from above
  Placement(Vec3 start, Angle azimuth);

  /// The vertical plane through two points; for a finish straight below the start, the x-z plane.
  [[nodiscard]] static Placement through(Vec3 start, Vec3 finish);

  [[nodiscard]] Vec3 start() const { return start_; }
  [[nodiscard]] Angle azimuth() const;

  /// @param x,drop  coordinates in the plane of the centerline [m]
  /// @param across  distance to the left of that plane [m]
  [[nodiscard]] Vec3 to_space(double x, double drop, double across) const;

 private:
  Vec3 start_;
  double cos_ = 1.0;
  double sin_ = 0.0;
};

}  // namespace glissade
