#pragma once

#include "glissade/core/vec.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace glissade::section {

/// The parts of a cross-section by what they are for; left and right as a body sees them that looks towards
/// the finish. A side may be several strokes.
enum class Side {
  floor,      ///< carries the body
  left_wall,  ///< inner surfaces beside the floor
  right_wall,
  rim,       ///< what lies level along the tops of walls, curbs and grooves
  underside  ///< everything outside: below the floor and behind the walls
};

/// @return "floor", "left wall", "right wall", "rim", "underside"
[[nodiscard]] std::string_view word(Side side);

/// A part of a circle, given from the circle's lowest point so that heights there are exact.
struct Arc {
  Vec2 bottom;          ///< lowest point of the whole circle [m]
  double radius = 0.0;  ///< > 0 [m]
  double from = 0.0;  ///< angles from the lowest point, seen from the centre, positive to +x [rad]; -pi to pi
  double to = 0.0;

  /// @return the point at an angle; mirrored angles give mirrored points, to the last digit
  [[nodiscard]] Vec2 at(double angle) const;
  [[nodiscard]] Vec2 centre() const { return {bottom.x, bottom.y + radius}; }

  friend bool operator==(const Arc&, const Arc&) = default;
};

/// One line or arc of an outline.
struct Stroke {
  Vec2 from;
  Vec2 to;
  Side side = Side::underside;
  std::optional<Arc> arc;  ///< none: a straight line

  /// @return [m]
  [[nodiscard]] double length() const;

  friend bool operator==(const Stroke&, const Stroke&) = default;
};

/// A closed row of strokes, each from where the one before it ends. Material lies to the left: an outer
/// outline runs counter-clockwise, a bore clockwise.
using Outline = std::vector<Stroke>;

/// @return enclosed area [m^2], arcs included; negative of a bore
[[nodiscard]] double area(const Outline& outline);
/// @return integral of the height over what is enclosed [m^3]; negative of a bore that lies above 0
[[nodiscard]] double first_moment(const Outline& outline);

}  // namespace glissade::section
