#include "glissade/core/arc_path.hpp"

#include "core/arc_pieces.hpp"

#include <algorithm>
#include <limits>

namespace glissade {
namespace {

/// Least distance between points inside two pieces where both are square to the line that joins them.
double inner_distance(const PathPiece& a, const PathPiece& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto hold = [&](Vec2 p, Vec2 q) {
    if (core::on_piece(a, p) && core::on_piece(b, q)) least = std::min(least, norm(p - q));
  };
  if (a.straight() && b.straight()) return least;
  if (a.straight()) return inner_distance(b, a);
  const Circle first = core::circle_of(a);
  if (b.straight()) {
    const Vec2 along = b.to - b.from;
    const double square = dot(along, along);
    if (square == 0.0) return least;
    const Vec2 foot = b.from + (dot(first.centre - b.from, along) / square) * along;
    const Vec2 out = foot - first.centre;
    if (norm(out) > 0.0) hold(first.centre + (first.radius / norm(out)) * out, foot);
    return least;
  }
  const Circle second = core::circle_of(b);
  const Vec2 apart = second.centre - first.centre;
  if (norm(apart) == 0.0) return least;
  const Vec2 along = (1.0 / norm(apart)) * apart;
  for (const double side : {-1.0, 1.0}) {
    for (const double other : {-1.0, 1.0}) {
      hold(first.centre + (side * first.radius) * along, second.centre + (other * second.radius) * along);
    }
  }
  return least;
}

}  // namespace

double distance(const PathPiece& a, const PathPiece& b) {
  if (!core::meetings(a, b).empty()) return 0.0;
  const double ends = std::min({core::distance_to_piece(a, b.from), core::distance_to_piece(a, b.to),
                                core::distance_to_piece(b, a.from), core::distance_to_piece(b, a.to)});
  return std::min(ends, inner_distance(a, b));
}

double distance(const ArcPath& a, const ArcPath& b) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<PathPiece> others = pieces_of(b);
  std::vector<PlaneBox> boxes;
  boxes.reserve(others.size());
  for (const PathPiece& piece : others) boxes.push_back(core::bounds_of(piece));
  for (const PathPiece& piece : pieces_of(a)) {
    const PlaneBox box = core::bounds_of(piece);
    for (std::size_t i = 0; i < others.size(); ++i) {
      if (core::gap(box, boxes[i]) < least) least = std::min(least, distance(piece, others[i]));
    }
  }
  return least;
}

}  // namespace glissade
