#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

namespace glissade {

/// Where a profile lies in space: a straight plan, upright and not banked.
///
/// A centerline stays planar: it is the profile, run and drop. What leads it through space is this, and positions are had
/// from it by run, drop and distance across alone; whoever asks so needs not know how the plan runs. A plan that bends
/// and a section that banks are further routes of the same three coordinates (docs/development.md, layers).
/// Identity: a value; parallel routes differ by a shift alone, lengths and angles are those of the profile.
/// Frame: x, y level, z up. "Across" counts to the left of a body that looks towards the finish.
class Placement {
 public:
  /// In the x-z plane with the start at the origin.
  Placement() = default;

  /// @param start    position of the start [m]
  /// @param azimuth  direction of the run, counter-clockwise from +x seen from above
  /// @throws InputError if a coordinate or the azimuth is not finite
  Placement(Vec3 start, Angle azimuth);

  /// The vertical plane through two points; for a finish straight below the start, the x-z plane.
  /// @throws InputError if a coordinate is not finite
  [[nodiscard]] static Placement through(Vec3 start, Vec3 finish);

  [[nodiscard]] Vec3 start() const { return start_; }
  /// @return the same plane, parallel, with its start at the origin
  [[nodiscard]] Placement at_origin() const;
  /// @return direction of the run, counter-clockwise from +x seen from above; -180 to 180 deg
  [[nodiscard]] Angle azimuth() const;

  /// @param x,drop  coordinates in the plane of the centerline [m]
  /// @param across  distance to the left of that plane [m]
  [[nodiscard]] Vec3 to_space(double x, double drop, double across) const {
    return {start_.x + (x * cos_ - across * sin_), start_.y + (x * sin_ + across * cos_), start_.z - drop};
  }

  /// @return x and drop of a point in space, seen square to the plane of the centerline [m]
  [[nodiscard]] Vec2 to_plane(Vec3 point) const {
    return {(point.x - start_.x) * cos_ + (point.y - start_.y) * sin_, start_.z - point.z};
  }

  friend bool operator==(const Placement&, const Placement&) = default;

 private:
  Vec3 start_;
  double cos_ = 1.0;
  double sin_ = 0.0;
};

}  // namespace glissade
