#include "glissade/core/arc_path.hpp"
#include "glissade/core/math.hpp"

#include "core/arc_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace glissade {
namespace {

/// Whether the level ray from `point` to the right crosses the part of a curve between two heights.
bool ray_crosses(Vec2 point, Vec2 from, Vec2 to, double crossing) {
  return (from.y <= point.y) != (to.y <= point.y) && crossing > point.x;
}

bool ray_crosses_line(Vec2 point, const PathPiece& line) {
  const Vec2 along = line.to - line.from;
  const double share = along.y == 0.0 ? 0.0 : (point.y - line.from.y) / along.y;
  return ray_crosses(point, line.from, line.to, line.from.x + share * along.x);
}

/// @return how often the ray crosses an arc: taken apart at the circle's top and bottom
int ray_crossings_of_arc(Vec2 point, const PathPiece& piece) {
  const Circle arc = core::circle_of(piece);
  std::vector<Vec2> stops{piece.from};
  const Vec2 top = arc.centre + Vec2{0.0, arc.radius};
  const Vec2 bottom = arc.centre - Vec2{0.0, arc.radius};
  if (core::on_arc(piece, top)) stops.push_back(top);
  if (core::on_arc(piece, bottom)) stops.push_back(bottom);
  const Vec2 along = piece.to - piece.from;
  const auto turned = [&](Vec2 p) {  // how far round the arc: grows from `from` to `to`
    const Vec2 a = piece.from - arc.centre;
    const Vec2 b = p - arc.centre;
    const double angle = math::atan2(cross(a, b), dot(a, b)) * (piece.bulge > 0.0 ? 1.0 : -1.0);
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
  };
  if (stops.size() == 3 && turned(stops[1]) > turned(stops[2])) std::swap(stops[1], stops[2]);
  stops.push_back(piece.from + along);
  stops.back() = piece.to;
  int crossings = 0;
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double up = point.y - arc.centre.y;
    const double square = (arc.radius - up) * (arc.radius + up);
    const double half = square > 0.0 ? std::sqrt(square) : 0.0;
    // A left turn that rises is on the right half of its circle.
    const bool right = (stops[i + 1].y > stops[i].y) == (piece.bulge > 0.0);
    const double crossing = arc.centre.x + (right ? half : -half);
    if (ray_crosses(point, stops[i], stops[i + 1], crossing)) ++crossings;
  }
  return crossings;
}

}  // namespace

bool contains(const ArcPath& path, Vec2 point) {
  int crossings = 0;
  for (const PathPiece& piece : pieces_of(path)) {
    // An arc of no more than half a turn stays within its rise of its chord.
    const double rise = 0.5 * std::fabs(piece.bulge) * norm(piece.to - piece.from);
    const bool beyond = point.y < std::min(piece.from.y, piece.to.y) - rise ||
                        point.y > std::max(piece.from.y, piece.to.y) + rise;
    if (std::fabs(piece.bulge) <= 1.0 && beyond) continue;
    crossings +=
        piece.straight() ? (ray_crosses_line(point, piece) ? 1 : 0) : ray_crossings_of_arc(point, piece);
  }
  return crossings % 2 == 1;
}

}  // namespace glissade
