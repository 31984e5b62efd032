#pragma once

#include "glissade/core/vec.hpp"

#include <span>
#include <vector>

namespace glissade::clearance {

/// Convex shapes of the plane: a point, a segment, or the corners of a polygon in order.
using Convex = std::vector<Vec2>;

/// @return the hull of points: as many corners as it has, 1 or 2 of points in one place or on one line
[[nodiscard]] Convex hull(Convex points);

/// @param signed_side  of a point, linear; >= 0 on the side that is kept
template <typename Side>
[[nodiscard]] Convex clipped_by(std::span<const Vec2> shape, const Side& signed_side) {
  Convex kept;
  if (shape.empty()) return kept;
  // A segment has one side, not two; the last round of a polygon leads back to its first corner.
  const std::size_t rounds = shape.size() <= 2 ? shape.size() - 1 : shape.size();
  double here = signed_side(shape[0]);
  for (std::size_t i = 0; i < rounds; ++i) {
    const Vec2 to = shape[(i + 1) % shape.size()];
    const double there = signed_side(to);
    if (here >= 0.0) kept.push_back(shape[i]);
    if ((here < 0.0) != (there < 0.0)) kept.push_back(shape[i] + here / (here - there) * (to - shape[i]));
    here = there;
  }
  if (shape.size() <= 2 && here >= 0.0) kept.push_back(shape.back());
  return kept;
}

/// @return the part of a convex shape in front of a line, the line's own points among it; nothing where there is none
[[nodiscard]] Convex clipped(std::span<const Vec2> shape, Vec2 on_line, Vec2 forward);

/// @return a convex shape that holds every point within a distance of this one, and none that is further from it than
///   sqrt(2) times that, nor beyond its runs by more than that distance
[[nodiscard]] Convex grown(std::span<const Vec2> shape, double distance);

}  // namespace glissade::clearance
