#include "parts/plates/frame_room.hpp"

#include "parts/bodies/body_mesh.hpp"
#include "parts/bodies/placed_piece.hpp"

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

}  // namespace

PlacedFacets placed_facets(const ShopPart& part) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const TriangleMesh mesh = facets_of(part.body, kChord);
  PlacedFacets placed{{}, {kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  for (const Frame& piece : part.places) {
    std::vector<Vec3> points;
    for (const Vec3 vertex : mesh.vertices) points.push_back(piece.to_space(vertex));
    for (const Vec3 point : points) {
      placed.low = {std::min(placed.low.x, point.x), std::min(placed.low.y, point.y),
                    std::min(placed.low.z, point.z)};
      placed.high = {std::max(placed.high.x, point.x), std::max(placed.high.y, point.y),
                     std::max(placed.high.z, point.z)};
    }
    for (const auto& facet : mesh.triangles)
      placed.facets.push_back({points[facet[0]], points[facet[1]], points[facet[2]]});
  }
  return placed;
}

double standing_out(const PlacedFacets& part, const FrameOpening& opening, const Frame& place,
                    double thickness, double reach) {
  // What lies beside the frame along the track is passed by at once.
  const Vec3 half = 0.5 * (part.high - part.low);
  const double middle = dot(0.5 * (part.low + part.high) - place.origin, place.z);
  const double extent =
      half.x * std::fabs(place.z.x) + half.y * std::fabs(place.z.y) + half.z * std::fabs(place.z.z);
  constexpr double kRounding = 1e-9;
  if (middle + extent < -kRounding || middle - extent > thickness + kRounding) return 0.0;
  double most = 0.0;
  const auto see = [&](Vec3 point) {
    const double out = outside_of(opening, {point.x, point.y});
    if (out <= reach) most = std::max(most, out);
  };
  for (const std::array<Vec3, 3>& facet : part.facets) {
    std::array<Vec3, 3> own;
    for (std::size_t k = 0; k < 3; ++k) own[k] = in_own(place, facet[k]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = own[k];
      const Vec3 b = own[(k + 1) % 3];
      if (std::max(a.z, b.z) < 0.0 || std::min(a.z, b.z) > thickness) continue;
      // The stretch of the edge within the frame: what stands out the most stands out at one of its ends.
      for (const double level : {std::clamp(a.z, 0.0, thickness), std::clamp(b.z, 0.0, thickness)}) {
        const double share = a.z == b.z ? 0.0 : (level - a.z) / (b.z - a.z);
        see(a + share * (b - a));
      }
    }
  }
  return most;
}

}  // namespace glissade::parts
