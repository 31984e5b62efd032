#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

#include <string_view>
#include <vector>

namespace glissade {

/// The shape that is swept along a centerline: one outline, and for a pipe one bore.
///
/// Frame: x across, positive to the left of a body that looks towards the finish; y height above the floor,
/// along the normal of the track towards its concave (upper) side. The floor's surface touches y = 0 at x =
/// 0: that point is the centerline. Metres.
class CrossSection {
 public:
  using Polygon = std::vector<Vec2>;

  /// A flat ramp: a plate under the floor, optionally with a curb along each side.
  /// @param curb_height,curb_width  0 for none
  [[nodiscard]] static CrossSection slab(double width, double thickness, double curb_height = 0.0,
                                         double curb_width = 0.0);
  /// Flat floor with upright walls; `width` and `wall_height` are inside measures.
  [[nodiscard]] static CrossSection u_channel(double width, double wall_height, double thickness);
  /// Flat floor with walls that lean outward by `wall_angle` from upright; inside measures, plate thickness
  /// measured square to each plate.
  [[nodiscard]] static CrossSection trapezoid(double floor_width, double wall_height, Angle wall_angle,
                                              double thickness);
  /// Half a round trough; `width` is the inside diameter. `wall_height` (optional, >= 0) continues the sides
  /// straight up.
  [[nodiscard]] static CrossSection half_pipe(double width, double thickness, double wall_height = 0.0);
  /// A closed pipe; the centerline is the lowest line of its bore.
  [[nodiscard]] static CrossSection pipe(double inner_diameter, double thickness);
  /// Any simple outline, either winding; (0, 0) must lie on it and the floor's surface there face up.
  [[nodiscard]] static CrossSection polygon(Polygon outline);

  /// @return the word that a design file uses, e.g. "u-channel"
  [[nodiscard]] std::string_view kind() const;

  /// @param chord_tolerance  greatest distance between a round outline and its polygon [m]; > 0
  /// @return outline, counter-clockwise; no repeated vertex
  [[nodiscard]] Polygon outline(double chord_tolerance) const;
  /// @return bore of a pipe, clockwise; empty for the others
  [[nodiscard]] Polygon bore(double chord_tolerance) const;
};

}  // namespace glissade
