#include "core/least_rectangle.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace glissade::core {

std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return std::pair(a.x, a.y) < std::pair(b.x, b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const Vec2 point : points) {
      while (hull.size() >= base + 2 &&
             cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double lying_angle(const std::vector<Vec2>& points) {
  const std::vector<Vec2> hull = hull_of(points);
  double least = std::numeric_limits<double>::infinity();
  double angle = 0.0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const double size = norm(edge);
    if (size == 0.0) continue;
    const Vec2 along = (1.0 / size) * edge;
    double low = 0.0;
    double high = 0.0;
    double up = 0.0;
    for (const Vec2 point : hull) {
      const double x = dot(along, point - hull[i]);
      low = std::min(low, x);
      high = std::max(high, x);
      up = std::max(up, cross(along, point - hull[i]));
    }
    const double area = (high - low) * up;
    if (area >= least * (1.0 - 1e-9)) continue;
    least = area;
    const double turn = -math::atan2(along.y, along.x);
    angle = high - low >= up ? turn : turn + 0.5 * std::numbers::pi;
  }
  return angle;
}

Vec2 least_size(const ArcPath& outline) {
  constexpr double kWorthTurning = 1e-3;  // of the area
  constexpr double kFineness = 1e-4;      // sagitta, of the longer side
  const auto sides = [](const PlaneBox& box) {
    return Vec2{std::max(box.width(), box.height()), std::min(box.width(), box.height())};
  };
  const Vec2 drawn = sides(bounds(outline));
  if (!(drawn.y > 0.0)) return drawn;
  const double angle = lying_angle(flattened(outline, kFineness * drawn.x));
  const Vec2 turned = sides(bounds(moved(outline, PlaneMotion::turn(angle))));
  return turned.x * turned.y < (1.0 - kWorthTurning) * drawn.x * drawn.y ? turned : drawn;
}

}  // namespace glissade::core
