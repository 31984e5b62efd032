#pragma once

#include "glissade/core/vec.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::core {

/// Distances and crossings in a plane, whatever its axes mean; all in the unit of the points.

/// @return distance from the segment a to b, a != b
[[nodiscard]] inline double distance_to_segment(Vec2 point, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double share = std::clamp(dot(point - a, along) / dot(along, along), 0.0, 1.0);
  return norm(point - (a + share * along));
}

/// @return distance from the endless line through a and b; from the point where both are one
[[nodiscard]] inline double distance_to_line(Vec2 point, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double length = norm(along);
  return length > 0.0 ? std::fabs(cross(along, point - a)) / length : norm(point - a);
}

/// Where two segments cross, as the share of the way along each.
struct Crossing {
  double first = 0.0;   ///< 0 to 1
  double second = 0.0;  ///< 0 to 1
};

/// @return where the segments a to b and c to d cross; none if they do not, or are parallel
[[nodiscard]] inline std::optional<Crossing> segment_crossing(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Vec2 along = b - a;
  const Vec2 other = d - c;
  const double area = cross(along, other);
  if (area == 0.0) return std::nullopt;
  const Crossing crossing{cross(c - a, other) / area, cross(c - a, along) / area};
  const auto within = [](double share) { return share >= 0.0 && share <= 1.0; };
  if (!within(crossing.first) || !within(crossing.second)) return std::nullopt;
  return crossing;
}

/// Source: Y.-D. Liang and B. A. Barsky, ACM Transactions on Graphics 3 (1984) 1-22.
/// @return whether some of the segment a to b lies in a rectangle along the axes; on its edges, too
[[nodiscard]] inline bool touches_rectangle(Vec2 a, Vec2 b, Vec2 low, Vec2 high) {
  double from = 0.0;
  double to = 1.0;
  const auto cut = [&](double at, double way, double least, double most) {
    if (way == 0.0) return at >= least && at <= most;
    const double first = (least - at) / way;
    const double second = (most - at) / way;
    from = std::max(from, std::min(first, second));
    to = std::min(to, std::max(first, second));
    return from <= to;
  };
  return cut(a.x, b.x - a.x, low.x, high.x) && cut(a.y, b.y - a.y, low.y, high.y);
}

/// @return true if the point lies within a simple polygon; on its edges either
[[nodiscard]] inline bool is_inside(Vec2 point, const std::vector<Vec2>& polygon) {
  bool odd = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) odd = !odd;
  }
  return odd;
}

}  // namespace glissade::core
