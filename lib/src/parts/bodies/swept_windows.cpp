#include "parts/bodies/swept_windows.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/body_places.hpp"

#include <algorithm>

namespace glissade::parts {

std::vector<Vec2> section_of(const SweptWindow& window, const BoreLine& line) {
  const Vec2 deep = line.thickness * Vec2{-line.across.y, line.across.x};
  const Vec2 low = line.foot + window.low * line.across;
  const Vec2 high = line.foot + window.high * line.across;
  return {low, high, high + deep, low + deep};
}

double beside(const SweptWindow& window, Vec2 place) {
  const double along = std::max(window.from - place.x, place.x - window.to);
  const double across = std::max(window.low - place.y, place.y - window.high);
  return along <= 0.0 || across <= 0.0 ? std::max(along, across) : math::hypot(along, across);
}

std::vector<Vec3> points_beside(const SweptBody& body, double inset) {
  std::vector<Vec3> points;
  const std::vector<PathPiece> pieces = pieces_of(body.path);
  for (const SweptWindow& window : body.windows) {
    const auto [i, begins] = piece_at(pieces, window.from);
    const BoreLine line = first_edge(body, i);
    const Vec2 into{-line.across.y, line.across.x};
    const double whole = length(pieces[i]);
    for (const double x : {window.from - inset, 0.5 * (window.from + window.to), window.to + inset}) {
      for (const double y : {window.low - inset, 0.5 * (window.low + window.high), window.high + inset}) {
        const double share = (x - begins) / whole;
        if (!(beside(window, {x, y}) > 0.0) || share < 0.0 || share > 1.0) continue;
        const Vec2 along = tangent_at(pieces[i], share);
        for (const double deep : {inset, line.thickness - inset}) {
          const Vec2 place = line.foot + y * line.across + deep * into;
          const Vec2 at = point_on(pieces[i], share) + place.x * Vec2{-along.y, along.x};
          points.push_back({at.x, at.y, place.y});
        }
      }
    }
  }
  return points;
}

}  // namespace glissade::parts
