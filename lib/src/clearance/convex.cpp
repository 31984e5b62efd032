#include "clearance/convex.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace glissade::clearance {

Convex hull(Convex points) {
  std::sort(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  Convex corners;
  const auto add = [&](Vec2 point, std::size_t least) {
    while (corners.size() >= least + 2 &&
           cross(corners.back() - corners[corners.size() - 2], point - corners.back()) <= 0.0) {
      corners.pop_back();
    }
    if (corners.empty() || !(corners.back() == point)) corners.push_back(point);
  };
  for (const Vec2 point : points) add(point, 0);
  const std::size_t upper = corners.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], upper);
  if (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
  return corners;
}

Convex clipped(std::span<const Vec2> shape, Vec2 on_line, Vec2 forward) {
  return clipped_by(shape, [&](Vec2 point) { return dot(point - on_line, forward); });
}

Convex grown(std::span<const Vec2> shape, double distance) {
  if (!(distance > 0.0)) return {shape.begin(), shape.end()};
  Convex points;
  points.reserve(4 * shape.size());
  for (const Vec2 corner : shape) {
    for (const Vec2 by : {Vec2{1.0, 1.0}, Vec2{1.0, -1.0}, Vec2{-1.0, 1.0}, Vec2{-1.0, -1.0}}) {
      points.push_back(corner + distance * by);
    }
  }
  return hull(std::move(points));
}

}  // namespace glissade::clearance
