#pragma once

#include "glissade/core/vec.hpp"

#include <cmath>
#include <optional>

namespace glissade::parts {

/// One arc, or straight line, by a place on it and what it does there.
struct ArcAt {
  Vec2 from;
  double heading = 0.0;
  double curvature = 0.0;

  /// @return signed distance of a point from the arc's circle, positive to the left
  [[nodiscard]] double distance(Vec2 point) const;
  /// @return the same arc a length further on
  [[nodiscard]] ArcAt after(double length) const;
};

/// @param along  direction of the heading at `from`
/// @return signed distance of a point from a circle, positive to the left
[[nodiscard]] inline double distance_from(Vec2 from, Vec2 along, double curvature, Vec2 point) {
  const Vec2 away = point - from;
  const double u = dot(along, away);
  const double v = cross(along, away);
  const double left = 1.0 - curvature * v;
  const double grade = std::sqrt(curvature * u * curvature * u + left * left);
  return 2.0 * (v - 0.5 * curvature * (u * u + v * v)) / (1.0 + grade);
}

/// @return sin(x) / x
[[nodiscard]] double sinc(double x);
/// @return an angle within half a turn of 0
[[nodiscard]] double wrapped(double angle);
[[nodiscard]] Vec2 direction_of(double heading);
[[nodiscard]] constexpr Vec2 left_of(Vec2 along) {
  return {-along.y, along.x};
}

/// The curvature of the circle that touches one leg where it begins, and another leg anywhere.
struct TouchingCurvature {
  double above = 0.0;
  double below = 0.0;  ///< where its sign changes the curvature goes through infinity

  [[nodiscard]] double value() const { return -above / below; }
};
[[nodiscard]] TouchingCurvature touching_curvature(const ArcAt& from, const ArcAt& other);

/// An arc from the end of one leg that touches the circle of another.
struct Touching {
  ArcAt leg;
  double length = 0.0;
  double beyond = 0.0;  ///< along the other leg from where that is known, to the place that is touched
};

/// @return none where the arc would run backwards or turn by more than a right angle
[[nodiscard]] std::optional<Touching> touching(const ArcAt& from, const ArcAt& other);

/// A joint of the biarcs between two points with two headings: the second arc starts there with the heading that the
/// first one ends with.
/// @param share  0 to 1: where along their locus
[[nodiscard]] Vec2 biarc_joint(Vec2 from, double heading, Vec2 to, double end_heading, double share);

}  // namespace glissade::parts
