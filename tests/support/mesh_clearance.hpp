#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/route/placement.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

/// The clearance of a built solid by brute force: the side view of every facet against an obstacle that goes on across
/// the track for ever, without any knowledge of the curve that the solid was made along.
namespace testing {

using glissade::Vec2;
using SideView = std::vector<std::array<Vec2, 3>>;

/// @return the facets of a mesh as (run, drop) in the plane of its centerline
inline SideView side_view(const glissade::TriangleMesh& mesh, const glissade::Placement& placement) {
  const glissade::Vec3 start = placement.start();
  const double azimuth = placement.azimuth().radians();
  SideView facets;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec2, 3> facet;
    for (std::size_t k = 0; k < 3; ++k) {
      const glissade::Vec3 at = mesh.vertices[triangle[k]] - start;
      facet[k] = {at.x * std::cos(azimuth) + at.y * std::sin(azimuth), -at.z};
    }
    facets.push_back(facet);
  }
  return facets;
}

inline bool inside_polygon(Vec2 point, const std::vector<Vec2>& outline) {
  int winding = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    if (a.y <= point.y && b.y > point.y && cross(b - a, point - a) > 0.0) ++winding;
    if (a.y > point.y && b.y <= point.y && cross(b - a, point - a) < 0.0) --winding;
  }
  return winding != 0;
}

inline double segment_distance(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto to_segment = [](Vec2 p, Vec2 from, Vec2 to) {
    const Vec2 along = to - from;
    const double square = dot(along, along);
    const double share = square > 0.0 ? std::clamp(dot(p - from, along) / square, 0.0, 1.0) : 0.0;
    return norm(p - from - share * along);
  };
  const double ends =
      std::min({to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)});
  const double area = cross(b - a, d - c);
  if (area == 0.0) return ends;
  const double first = cross(c - a, d - c) / area;
  const double second = cross(c - a, b - a) / area;
  return first >= 0.0 && first <= 1.0 && second >= 0.0 && second <= 1.0 ? 0.0 : ends;
}

/// @param closed  a polygon, whose inside counts; else a line
/// @return least distance between any facet and the obstacle; 0 where they meet
inline double mesh_distance(const SideView& facets, const std::vector<Vec2>& obstacle, bool closed) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t sides = closed ? obstacle.size() : obstacle.size() - 1;
  for (const auto& facet : facets) {
    if (closed && inside_polygon(facet[0], obstacle)) return 0.0;
    if (inside_polygon(obstacle[0], {facet.begin(), facet.end()})) return 0.0;
    for (std::size_t i = 0; i < sides; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        least = std::min(least, segment_distance(facet[k], facet[(k + 1) % 3], obstacle[i],
                                                 obstacle[(i + 1) % obstacle.size()]));
      }
    }
  }
  return least;
}

}  // namespace testing
