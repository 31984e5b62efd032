#include "parts/bodies/body_depth.hpp"

#include "glissade/core/math.hpp"

#include "core/arc_pieces.hpp"
#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_places.hpp"
#include "parts/bodies/swept_windows.hpp"
#include "parts/bodies/tube_windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace glissade::parts {
namespace {

constexpr double kFar = 1e300;
/// By how much what lies along two pieces of a path reaches into each other, so that no point falls between them [m].
constexpr double kOverlap = 20e-6;

double distance_to(const ArcPath& path, Vec2 point) {
  double least = std::numeric_limits<double>::infinity();
  for (const PathPiece& piece : pieces_of(path)) {
    // No point of an arc of up to half a turn is farther from its middle than half its chord and its rise.
    const double half = 0.5 * norm(piece.to - piece.from);
    const double away = norm(point - 0.5 * (piece.from + piece.to));
    if (std::fabs(piece.bulge) <= 1.0 && away - half * (1.0 + std::fabs(piece.bulge)) > least) continue;
    least = std::min(least, core::distance_to_piece(piece, point));
  }
  return least;
}

double depth_in(const PlaneRegion& region, Vec2 point) {
  double edge = distance_to(region.outline, point);
  bool inside = contains(region.outline, point);
  for (const ArcPath& cutout : region.cutouts) {
    edge = std::min(edge, distance_to(cutout, point));
    inside = inside && !contains(cutout, point);
  }
  return inside ? edge : -edge;
}

double depth_in(const Prism& prism, Vec3 point) {
  const double between = std::min(point.z, prism.depth - point.z);
  if (between <= 0.0) return between;
  const double flat = depth_in(prism.region, Vec2{point.x, point.y});
  return flat > 0.0 ? std::min(flat, between) : flat;
}

double depth_in(const AngleBar& bar, Vec3 point) {
  const auto legs = legs_of(bar);
  return std::max(depth_in(legs[0], point), depth_in(legs[1], point));
}

/// Where a point lies beside a piece of a path.
struct Beside {
  double along = 0.0;  ///< from the piece's start
  double above = 0.0;  ///< to its left
};

Beside beside(const PathPiece& piece, Vec2 point) {
  // The circle of an arc that rises less than this is so large that the distance from it is lost in rounding.
  constexpr double kFlatRise = 1e-8;
  if (0.5 * std::fabs(piece.bulge) * norm(piece.to - piece.from) < kFlatRise) {
    const Vec2 tangent = tangent_at(piece, 0.0);
    return {dot(point - piece.from, tangent), cross(tangent, point - piece.from)};
  }
  const Circle arc = core::circle_of(piece);
  const Vec2 spoke = point - arc.centre;
  const Vec2 start = piece.from - arc.centre;
  const double sense = piece.bulge > 0.0 ? 1.0 : -1.0;
  return {sense * arc.radius * math::atan2(cross(start, spoke), dot(start, spoke)),
          sense * (arc.radius - norm(spoke))};
}

/// The depth of a point inside what lies along a path.
/// @param across  (piece, share of it, height above it): depth square to the path
/// @param mitres  as mitres_of(); none: no two pieces meet at a bend
template <typename Across>
double depth_along(const std::vector<PathPiece>& pieces, Vec2 point, Across across,
                   const std::vector<double>& mitres = {}) {
  double deepest = -kFar;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    // Ends of the body alone count as faces.
    const auto [along, above] = beside(pieces[i], point);
    const double whole = length(pieces[i]);
    double to_start = along;
    double to_end = whole - along;
    if (!mitres.empty() && (mitres[i] != 0.0 || mitres[i + 1] != 0.0)) {
      to_start = (along - above * mitres[i]) / math::hypot(1.0, mitres[i]);
      to_end = (whole - along - above * mitres[i + 1]) / math::hypot(1.0, mitres[i + 1]);
    }
    const double from_start = i == 0 ? to_start : to_start + kOverlap;
    const double from_end = (i + 1 == pieces.size() ? 0.0 : kOverlap) + to_end;
    const double lengthwise = std::min(i == 0 ? from_start : kFar, i + 1 == pieces.size() ? from_end : kFar);
    if (from_start < 0.0 || from_end < 0.0) {
      deepest = std::max(deepest, std::min(from_start, from_end));
      continue;
    }
    const double flat_depth = across(i, std::clamp(along / whole, 0.0, 1.0), above);
    deepest = std::max(deepest, flat_depth > 0.0 ? std::min(flat_depth, lengthwise) : flat_depth);
  }
  return deepest;
}

double depth_in(const SweptBody& body, Vec3 point) {
  const std::vector<PathPiece> pieces = pieces_of(body.path);
  return depth_along(pieces, {point.x, point.y}, [&](std::size_t i, double share, double above) {
    double depth = depth_in(polygon_of(section_at(body, i, share)), Vec2{above, point.z});
    for (const SweptWindow& window : body.windows) {
      const auto [piece, begins] = piece_at(pieces, window.from);
      if (piece != i) continue;
      const BoreLine line = first_edge(body, i);
      const double y = dot(Vec2{above, point.z} - line.foot, line.across);
      depth = std::min(depth, parts::beside(window, Vec2{begins + share * length(pieces[i]), y}));
    }
    return depth;
  });
}

double depth_in(const RolledSheet& sheet, Vec3 point) {
  const std::vector<PathPiece> pieces = pieces_of(sheet.path);
  const std::vector<double> starts = starts_of(pieces);
  return depth_along(
      pieces, {point.x, point.y},
      [&](std::size_t i, double share, double above) {
        const Vec2 away = Vec2{above, point.z} - sheet.foot;
        const double depth = dot(Vec2{-sheet.across.y, sheet.across.x}, away);
        const double between = std::min(depth, sheet.thickness - depth);
        if (between <= 0.0) return between;
        const double x = starts[i] + share * length(pieces[i]);
        // Where it would be on the upper face, edges leaning as they do.
        const double lower = dot(sheet.across, away);
        double y = lower;
        constexpr int kRounds = 40;
        for (int k = 0; k < kRounds && !sheet.bevels.empty(); ++k)
          y = lower - depth / sheet.thickness * bevel_at(sheet, y);
        const double flat = depth_in(sheet.region, Vec2{x, y});
        return flat > 0.0 ? std::min(flat, between) : flat;
      },
      mitres_of(sheet));
}

double depth_in(const TroughGore& gore, Vec3 point) {
  const double radius = point.x < 0.0 ? math::hypot(point.x, point.y) : std::fabs(point.y);
  const double start =
      (point.z - point.x * math::tan(gore.start_tilt.radians())) * math::cos(gore.start_tilt.radians());
  const double end = (gore.length + point.x * math::tan(gore.end_tilt.radians()) - point.z) *
                     math::cos(gore.end_tilt.radians());
  double depth = std::min({radius - gore.inner_radius, gore.inner_radius + gore.thickness - radius, start,
                           end, gore.side - point.x});
  for (const TubeWindow& window : gore.windows) depth = std::min(depth, parts::beside(window, point));
  return depth;
}

double depth_in(const FoldedPlate& plate, Vec3 point) {
  double deepest = -kFar;
  const std::size_t count = plate.corners.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const FacetPlanes planes = planes_of(plate.corners[i], plate.corners[i + 1]);
    double depth = kFar;
    for (std::size_t k = 0; k < 6; ++k) {
      double inside = -dot(point - planes.origins[k], planes.outward[k]);
      // Bends are no faces: beyond them the next facet goes on.
      const bool bend = (k == 4 && i > 0) || (k == 5 && i + 1 < count);
      if (bend && inside > -kOverlap) inside = kFar;
      depth = std::min(depth, inside);
    }
    deepest = std::max(deepest, depth);
  }
  return deepest;
}

double depth_in(const MeshBody& /*body*/, Vec3 /*point*/) {
  return -kFar;
}

double depth_in(const TubeGore& gore, Vec3 point) {
  const double radius = math::hypot(point.x, point.y);
  const double start =
      (point.z - point.x * math::tan(gore.start_tilt.radians())) * math::cos(gore.start_tilt.radians());
  const double end = (gore.length + point.x * math::tan(gore.end_tilt.radians()) - point.z) *
                     math::cos(gore.end_tilt.radians());
  double depth =
      std::min({radius - gore.inner_radius, gore.inner_radius + gore.thickness - radius, start, end});
  for (const TubeWindow& window : gore.windows) depth = std::min(depth, parts::beside(window, point));
  return depth;
}

}  // namespace

double depth_inside(const PartBody& body, Vec3 point) {
  return std::visit([&](const auto& one) { return depth_in(one, point); }, body);
}

}  // namespace glissade::parts
