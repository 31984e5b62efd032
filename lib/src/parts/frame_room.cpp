#include "parts/frame_room.hpp"

#include "parts/body_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::parts {
namespace {

constexpr double kChord = 1e-5;  // of arcs [m]

/// How far a point lies outside: of a convex outline the greatest distance beyond one of its sides.
double outside_of(const FrameOpening& opening, Vec2 point) {
  const std::size_t count = opening.outside.size();
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + (opening.ring ? 0 : 1) < count; ++i) {
    const Vec2 from = opening.outside[i];
    const Vec2 along = opening.outside[(i + 1) % count] - from;
    if (norm(along) > 0.0) most = std::max(most, cross(along, point - from) / norm(along));
  }
  return most;
}

Vec3 in_own(const Frame& place, Vec3 point) {
  const Vec3 from = point - place.origin;
  return {dot(from, place.x), dot(from, place.y), dot(from, place.z)};
}

}  // namespace

double standing_out(const ShopPart& part, const FrameOpening& opening, const Frame& place, double thickness,
                    double reach) {
  const TriangleMesh mesh = facets_of(part.body, kChord);
  double most = 0.0;
  const auto see = [&](Vec3 point) {
    const double out = outside_of(opening, {point.x, point.y});
    if (out <= reach) most = std::max(most, out);
  };
  for (const Frame& piece : part.places) {
    std::vector<Vec3> points;
    for (const Vec3 vertex : mesh.vertices) points.push_back(in_own(place, piece.to_space(vertex)));
    for (const auto& facet : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = points[facet[k]];
        const Vec3 b = points[facet[(k + 1) % 3]];
        if (std::max(a.z, b.z) < 0.0 || std::min(a.z, b.z) > thickness) continue;
        // The stretch of the edge within the frame: what stands out the most stands out at one of its ends.
        for (const double level : {std::clamp(a.z, 0.0, thickness), std::clamp(b.z, 0.0, thickness)}) {
          const double share = a.z == b.z ? 0.0 : (level - a.z) / (b.z - a.z);
          see(a + share * (b - a));
        }
      }
    }
  }
  return most;
}

}  // namespace glissade::parts
