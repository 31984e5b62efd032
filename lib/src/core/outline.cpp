#include "core/outline.hpp"

#include "core/counted.hpp"
#include "core/plane_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace glissade::core {
namespace {

constexpr std::size_t kMostCorners = 2000;
constexpr double kFarthestCorner = 1e7;  // [m]
constexpr double kShortestEdge = 1e-6;   // [m]

double doubled_area(const std::vector<Vec2>& outline) {
  double sum = 0.0;
  for (std::size_t index = 0; index < outline.size(); ++index) {
    sum += cross(outline[index], outline[(index + 1) % outline.size()]);
  }
  return sum;
}

/// Orientation of c against the line through a and b: 1 left, -1 right, 0 on it.
int side(Vec2 a, Vec2 b, Vec2 c) {
  const double area = cross(b - a, c - a);
  return area > 0.0 ? 1 : area < 0.0 ? -1 : 0;
}

bool within_box(Vec2 a, Vec2 b, Vec2 point) {
  return std::min(a.x, b.x) <= point.x && point.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= point.y &&
         point.y <= std::max(a.y, b.y);
}

bool on_edge(Vec2 a, Vec2 b, Vec2 point) {
  return side(a, b, point) == 0 && within_box(a, b, point);
}

bool edges_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
  return on_edge(a, b, c) || on_edge(a, b, d) || on_edge(c, d, a) || on_edge(c, d, b);
}

/// @return the first two edges that cross or touch without being neighbours
std::optional<std::pair<std::size_t, std::size_t>> crossing_edges(const std::vector<Vec2>& outline) {
  const std::size_t count = outline.size();
  for (std::size_t first = 0; first < count; ++first) {
    for (std::size_t second = first + 2; second < count; ++second) {
      if (first == 0 && second + 1 == count) continue;
      if (edges_meet(outline[first], outline[first + 1], outline[second], outline[(second + 1) % count])) {
        return std::pair{first, second};
      }
    }
  }
  return {};
}

/// @return the first two neighbouring corners that are one point
std::optional<std::pair<std::size_t, std::size_t>> repeated_corner(const std::vector<Vec2>& outline) {
  for (std::size_t index = 0; index < outline.size(); ++index) {
    const std::size_t next = (index + 1) % outline.size();
    if (norm(outline[next] - outline[index]) < kShortestEdge) return std::pair{index, next};
  }
  return {};
}

std::string pair_text(const std::pair<std::size_t, std::size_t>& pair) {
  return std::to_string(pair.first) + " and " + std::to_string(pair.second);
}

}  // namespace

std::optional<Issue> outline_fault(const std::vector<Vec2>& outline, const std::string& name) {
  const auto fault = [&](const std::string& what, const char* why, const char* hint) {
    return Issue{"", name + ": " + what, why, hint};
  };
  if (outline.size() < 3 || outline.size() > kMostCorners) {
    return fault(counted(outline.size(), "corner"), "An outline has between 3 and 2000 corners.",
                 "[[2 m, 3 m], [4 m, 3 m], [4 m, 5 m]]");
  }
  for (std::size_t index = 0; index < outline.size(); ++index) {
    const Vec2 corner = outline[index];
    if (std::fabs(corner.x) <= kFarthestCorner && std::fabs(corner.y) <= kFarthestCorner) continue;
    return fault("corner " + std::to_string(index) + " is out of range", "Corners lie within 10000 km.",
                 "a local origin, and the unit of each coordinate");
  }
  if (const auto repeated = repeated_corner(outline)) {
    return fault("corners " + pair_text(*repeated) + " are the same point",
                 "The outline closes by itself; neighbouring corners are at least 0.001 mm apart.",
                 "each corner once");
  }
  if (const auto crossing = crossing_edges(outline)) {
    return fault("the edges after corners " + pair_text(*crossing) + " meet",
                 "An outline does not cross or touch itself.", "the order of the corners");
  }
  if (!(std::fabs(doubled_area(outline)) > 0.0)) return fault("encloses nothing", "It has an area.", "");
  return {};
}

bool touches_outline(const std::vector<Vec2>& outline, Vec2 point) {
  for (std::size_t index = 0; index < outline.size(); ++index) {
    if (on_edge(outline[index], outline[(index + 1) % outline.size()], point)) return true;
  }
  return false;
}

bool inside_outline(const std::vector<Vec2>& outline, Vec2 point) {
  if (touches_outline(outline, point)) return true;
  return is_inside(point, outline);
}

}  // namespace glissade::core
