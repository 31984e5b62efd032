#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/section/measures.hpp"
#include "glissade/section/outline.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace glissade {

/// The shape that is swept along a centerline: outlines of lines and arcs whose sides have names.
///
/// Frame: x across, positive to the left of a body that looks towards the finish; y height above the floor,
///   along the normal of the track towards its concave (upper) side. The floor's lowest line is at y = 0; but
///   for a track-groove, whose floor lies on both sides of it, it passes through (0, 0): that point is the
///   centerline. Metres.
/// Where the width changes along the track (section::Measures, a WidthLaw), the corners beside the floor move across
///   with it and no height changes. What takes no arc length below is then that of the start; heights hold everywhere.
/// Accuracy: area and first moment are those of the true shape, arcs included, to rounding.
/// Identity: an immutable value; equal ones sweep to equal solids. Every kind but the polygon is its own mirror
///   image.
/// Every constructor throws InputError if a size is not finite and positive (those that may be 0 say so), or
/// breaks the bound given with it; the message begins with the key of the measure, and names its value and the
/// bound.
class CrossSection {
 public:
  using Polygon = std::vector<Vec2>;

  /// What each kind asks of its measures stands with the named constructor below.
  explicit CrossSection(const section::Measures& measures);

  /// @param curb_height,curb_width  both 0 for none; the plate reaches under the curbs, which stand outside
  ///   `width`
  [[nodiscard]] static CrossSection slab(double width, double thickness, double curb_height = 0.0,
                                         double curb_width = 0.0);
  /// @param thickness  of floor and walls; < width
  [[nodiscard]] static CrossSection u_channel(double width, double wall_height, double thickness);
  /// Plate thickness is measured square to each plate, wall tops are level.
  /// @param wall_angle  0 to kMaxWallAngle from upright
  /// @param thickness  < floor_width
  [[nodiscard]] static CrossSection trapezoid(double floor_width, double wall_height, Angle wall_angle,
                                              double thickness);
  /// @param width  inside diameter
  /// @param thickness  < width
  /// @param wall_height  how far the sides continue straight up; >= 0
  [[nodiscard]] static CrossSection half_pipe(double width, double thickness, double wall_height = 0.0);
  /// @param thickness  < inner_diameter
  [[nodiscard]] static CrossSection pipe(double inner_diameter, double thickness);
  /// @param angle  between the walls; kLeastVAngle to kMostVAngle
  /// @param bottom_radius  inside; its arc ends below the wall tops
  /// @param thickness  of walls and bottom, which is round outside too
  [[nodiscard]] static CrossSection v_channel(Angle angle, double bottom_radius, double wall_height,
                                              double thickness);
  /// @param groove_spacing  between the middles of the grooves; > groove_width
  /// @param width  > groove_spacing + groove_width
  [[nodiscard]] static CrossSection track_groove(double width, double groove_width, double groove_depth,
                                                 double groove_spacing, double thickness);
  /// Any simple outline, either winding; (0, 0) must lie on it and the floor's surface there face up. Sides
  /// that join the highest points left and right of (0, 0) over it are floor where they are flatter than 45
  /// deg, else walls; level sides at the highest points are rims; the others are underside.
  /// @param outline  3 to kMaxOutlineVertices vertices, without the first one repeated at the end
  /// @throws InputError if two sides cross or touch, a side has no length, or the origin is not on a side
  ///   that faces up; names the sides by their number, counted from 1
  [[nodiscard]] static CrossSection polygon(Polygon outline);

  /// Steepest lean of a trapezoid's walls.
  static constexpr Angle kMaxWallAngle = Angle::from_degrees(80.0);
  static constexpr Angle kLeastVAngle = Angle::from_degrees(20.0);
  static constexpr Angle kMostVAngle = Angle::from_degrees(170.0);
  static constexpr std::size_t kMaxOutlineVertices = 2000;
  /// What a length of a section may be [m]: area and moment stay within the range of numbers.
  static constexpr double kSmallestLength = 1e-100;
  static constexpr double kLargestLength = 1e100;
  /// Most that a width may change over a length, over that length: each wall turns by 45 deg from the track.
  static constexpr double kSteepestWidening = 2.0;

  /// @return the word that a design file uses, e.g. "u-channel"
  [[nodiscard]] std::string_view kind() const { return kind_; }

  /// @return whether the width changes along the track
  [[nodiscard]] bool varies() const { return varies_; }
  /// @return the law of a width that may change along the track; none for kinds without one
  [[nodiscard]] std::optional<WidthLaw> width_law() const { return section::width_law(measures_); }
  /// @param s  arc length [m]
  /// @return the section there, with the same width everywhere
  [[nodiscard]] CrossSection at(double s) const;
  /// @return the section where it is narrowest, with the same width everywhere; every corner lies on the line between
  ///         its place there and that at the widest, as far along it as the width
  [[nodiscard]] CrossSection at_narrowest() const;
  [[nodiscard]] CrossSection at_widest() const;

  /// @return the outline, and after it the bore if there is one
  [[nodiscard]] const std::vector<section::Outline>& loops() const { return loops_; }
  /// @return the strokes of one side in the order of the outline, those of the bore after it
  [[nodiscard]] std::vector<section::Stroke> strokes(section::Side side) const;

  /// Round parts become chords whose ends lie on the true arc, inner and outer arc cut at the same angles: a
  /// plate keeps its thickness, a bore loses at most `chord_tolerance` of clearance between two vertices and
  /// none at them. (0, 0) is a vertex of every round section. Left and right are exact mirror images.
  /// @param chord_tolerance  greatest distance between a round outline and its polygon [m]; > 0
  /// @throws InputError if it is not above zero, as of bore(), vertex_count() and chord_error()
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
  [[nodiscard]] double lowest() const { return lowest_; }
  /// @return height of the highest point [m]; >= 0
  [[nodiscard]] double highest() const { return highest_; }
  /// @return radius of the widest arc of the outline [m]; 0 where nothing is round
  [[nodiscard]] double widest_radius() const { return widest_radius_; }
  /// @return the narrowest place: least distance between two sides that do not share a vertex [m]; square to walls
  ///         that turn as the width changes
  [[nodiscard]] double narrowest() const { return narrowest_; }

  friend bool operator==(const CrossSection&, const CrossSection&) = default;

 private:
  [[nodiscard]] double half_step(double chord_tolerance) const;
  [[nodiscard]] Polygon polygon_of(const section::Outline& outline, double chord_tolerance) const;

  section::Measures measures_;
  bool varies_ = false;
  std::string_view kind_;
  std::vector<section::Outline> loops_;
  double narrowest_ = 0.0;
  double lowest_ = 0.0;
  double highest_ = 0.0;
  double widest_radius_ = 0.0;
};

}  // namespace glissade
