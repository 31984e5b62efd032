#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace glissade {

/// The shape that is swept along a centerline: one outline, and for a pipe one bore.
///
/// Frame: x across, positive to the left of a body that looks towards the finish; y height above the floor,
///   along the normal of the track towards its concave (upper) side. The floor's surface touches y = 0 at
///   x = 0: that point is the centerline. Metres.
/// Accuracy: area and first moment are those of the true shape, arcs included, to rounding.
/// Identity: an immutable value; equal ones sweep to equal solids.
/// Every named constructor throws InputError if a size is not finite and positive (those that may be 0 say
/// so), or breaks the bound given with it; the message names the size, its value and the bound.
class CrossSection {
 public:
  using Polygon = std::vector<Vec2>;

  /// A flat ramp: a plate under the floor, optionally with a curb along each side.
  /// @param width  of the floor, between the curbs where there are any
  /// @param curb_height,curb_width  both 0 for none; the plate reaches under the curbs
  [[nodiscard]] static CrossSection slab(double width, double thickness, double curb_height = 0.0,
                                         double curb_width = 0.0);
  /// Flat floor with upright walls; `width` and `wall_height` are inside measures.
  /// @param thickness  of floor and walls; < width
  [[nodiscard]] static CrossSection u_channel(double width, double wall_height, double thickness);
  /// Flat floor with walls that lean outward by `wall_angle` from upright; inside measures, plate thickness
  /// measured square to each plate, wall tops level.
  /// @param wall_angle  0 to kMaxWallAngle
  /// @param thickness  < floor_width
  [[nodiscard]] static CrossSection trapezoid(double floor_width, double wall_height, Angle wall_angle,
                                              double thickness);
  /// Half a round trough; `width` is the inside diameter.
  /// @param thickness  < width
  /// @param wall_height  how far the sides continue straight up; >= 0
  [[nodiscard]] static CrossSection half_pipe(double width, double thickness, double wall_height = 0.0);
  /// A closed pipe; the centerline is the lowest line of its bore.
  /// @param thickness  < inner_diameter
  [[nodiscard]] static CrossSection pipe(double inner_diameter, double thickness);
  /// Any simple outline, either winding; (0, 0) must lie on it and the floor's surface there face up.
  /// @param outline  3 to kMaxOutlineVertices vertices, without the first one repeated at the end
  /// @throws InputError if two sides cross or touch, a side has no length, or the origin is not on a side
  ///   that faces up; names the sides by their number, counted from 1
  [[nodiscard]] static CrossSection polygon(Polygon outline);

  /// Steepest lean of a trapezoid's walls.
  static constexpr Angle kMaxWallAngle = Angle::from_degrees(85.0);
  static constexpr std::size_t kMaxOutlineVertices = 4096;

  /// @return the word that a design file uses, e.g. "u-channel"
  [[nodiscard]] std::string_view kind() const;

  /// Round parts become chords whose ends lie on the true arc, inner and outer arc cut at the same angles: a
  /// plate keeps its thickness, a bore loses at most `chord_tolerance` of clearance between two vertices and
  /// none at them. (0, 0) is a vertex of every round section. Left and right are exact mirror images.
  /// @param chord_tolerance  greatest distance between a round outline and its polygon [m]; > 0
  /// @return outline, counter-clockwise; no repeated vertex
  [[nodiscard]] Polygon outline(double chord_tolerance) const;
  /// @return bore of a pipe, clockwise; empty for the others
  [[nodiscard]] Polygon bore(double chord_tolerance) const;
  /// @return how many vertices outline() and bore() have together, without making them
  [[nodiscard]] double vertex_count(double chord_tolerance) const;
  /// @return distance really left between the round outline and its polygon [m]; 0 where nothing is round
  [[nodiscard]] double chord_error(double chord_tolerance) const;

  /// @return A, area of the material [m^2]
  [[nodiscard]] double area() const;
  /// @return M = integral of the height over the material [m^3]
  [[nodiscard]] double first_moment() const;
  /// @return height of the lowest point [m]; <= 0
  [[nodiscard]] double lowest() const;
  /// @return height of the highest point [m]; >= 0
  [[nodiscard]] double highest() const;
  /// @return radius of the widest arc of the outline [m]; 0 where nothing is round
  [[nodiscard]] double widest_radius() const { return round() ? 0.5 * diameter_ + thickness_ : 0.0; }
  /// @return the narrowest place: least distance between two sides that do not share a vertex [m]
  [[nodiscard]] double narrowest() const;

  friend bool operator==(const CrossSection&, const CrossSection&) = default;

 private:
  enum class Kind { slab, u_channel, trapezoid, half_pipe, pipe, polygon };

  explicit CrossSection(Kind kind) : kind_(kind) {}

  [[nodiscard]] bool round() const { return kind_ == Kind::half_pipe || kind_ == Kind::pipe; }

  Kind kind_;
  double diameter_ = 0.0;   // inside, of the round kinds
  double thickness_ = 0.0;  // of the round kinds
  double wall_height_ = 0.0;
  double narrowest_ = 0.0;
  Polygon corners_;  // of the kinds without arcs, counter-clockwise
};

}  // namespace glissade
