#include "core/arc_pieces.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::core {
namespace {

void add_meetings_of_lines(const PathPiece& a, const PathPiece& b, std::vector<Vec2>& found) {
  const Vec2 u = a.to - a.from;
  const Vec2 v = b.to - b.from;
  const double turn = cross(u, v);
  if (turn == 0.0) return;  // parallel: where they touch, an end of one lies on the other
  const double share = cross(b.from - a.from, v) / turn;
  const double other = cross(b.from - a.from, u) / turn;
  if (share >= 0.0 && share <= 1.0 && other >= 0.0 && other <= 1.0) found.push_back(a.from + share * u);
}

void add_meetings(const PathPiece& line, const PathPiece& piece, const Circle& arc,
                  std::vector<Vec2>& found) {
  const Vec2 u = line.to - line.from;
  const double size = norm(u);
  if (size == 0.0) return;
  const Vec2 along = (1.0 / size) * u;
  const double beside = cross(along, arc.centre - line.from);
  if (std::fabs(beside) > arc.radius) return;
  const double half = std::sqrt((arc.radius - beside) * (arc.radius + beside));
  const double foot = dot(along, arc.centre - line.from);
  for (const double place : {foot - half, foot + half}) {
    const Vec2 point = line.from + place * along;
    if (place >= 0.0 && place <= size && on_arc(piece, point)) found.push_back(point);
  }
}

void add_meetings_of_arcs(const PathPiece& a, const PathPiece& b, std::vector<Vec2>& found) {
  const Circle first = circle_of(a);
  const Circle second = circle_of(b);
  const Vec2 apart = second.centre - first.centre;
  const double d = norm(apart);
  if (d == 0.0 || d > first.radius + second.radius || d < std::fabs(first.radius - second.radius)) return;
  const Vec2 along = (1.0 / d) * apart;
  const double foot = 0.5 * (d + (first.radius - second.radius) * (first.radius + second.radius) / d);
  const double square = (first.radius - foot) * (first.radius + foot);
  const double half = square > 0.0 ? std::sqrt(square) : 0.0;
  for (const double side : {-half, half}) {
    const Vec2 point = first.centre + foot * along + side * Vec2{-along.y, along.x};
    if (on_arc(a, point) && on_arc(b, point)) found.push_back(point);
  }
}

}  // namespace

Circle circle_of(const PathPiece& piece) {
  const Vec2 along = piece.to - piece.from;
  const double b = piece.bulge;
  return {0.5 * (piece.from + piece.to) + ((1.0 - b * b) / (4.0 * b)) * Vec2{-along.y, along.x},
          norm(along) * (1.0 + b * b) / (4.0 * std::fabs(b))};
}

bool on_arc(const PathPiece& arc, Vec2 point) {
  return cross(arc.to - arc.from, point - arc.from) * arc.bulge <= 0.0;
}

bool on_piece(const PathPiece& piece, Vec2 point) {
  if (!piece.straight()) return on_arc(piece, point);
  const Vec2 along = piece.to - piece.from;
  const double share = dot(point - piece.from, along);
  return share >= 0.0 && share <= dot(along, along);
}

void widen(PlaneBox& box, Vec2 point) {
  box.low = {std::min(box.low.x, point.x), std::min(box.low.y, point.y)};
  box.high = {std::max(box.high.x, point.x), std::max(box.high.y, point.y)};
}

PlaneBox empty_box() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
}

PlaneBox bounds_of(const PathPiece& piece) {
  PlaneBox box = empty_box();
  widen(box, piece.from);
  widen(box, piece.to);
  if (piece.straight()) return box;
  const Circle arc = circle_of(piece);
  for (const Vec2 side : {Vec2{1, 0}, Vec2{0, 1}, Vec2{-1, 0}, Vec2{0, -1}}) {
    const Vec2 point = arc.centre + arc.radius * side;
    if (on_arc(piece, point)) widen(box, point);
  }
  return box;
}

double gap(const PlaneBox& a, const PlaneBox& b) {
  const double beside = std::max({a.low.x - b.high.x, b.low.x - a.high.x, 0.0});
  const double above = std::max({a.low.y - b.high.y, b.low.y - a.high.y, 0.0});
  return math::hypot(beside, above);
}

double distance_to_piece(const PathPiece& piece, Vec2 point) {
  double least = std::min(norm(point - piece.from), norm(point - piece.to));
  if (piece.straight()) {
    const Vec2 along = piece.to - piece.from;
    const double square = dot(along, along);
    if (square > 0.0 && on_piece(piece, point)) {
      least = std::min(least, std::fabs(cross(along, point - piece.from)) / std::sqrt(square));
    }
    return least;
  }
  const Circle arc = circle_of(piece);
  const Vec2 outward = point - arc.centre;
  const double far = norm(outward);
  if (far > 0.0 && on_arc(piece, arc.centre + (arc.radius / far) * outward)) {
    least = std::min(least, std::fabs(far - arc.radius));
  }
  return least;
}

std::vector<Vec2> meetings(const PathPiece& a, const PathPiece& b) {
  std::vector<Vec2> found;
  if (a.straight() && b.straight()) {
    add_meetings_of_lines(a, b, found);
  } else if (a.straight()) {
    add_meetings(a, b, circle_of(b), found);
  } else if (b.straight()) {
    add_meetings(b, a, circle_of(a), found);
  } else {
    add_meetings_of_arcs(a, b, found);
  }
  return found;
}

}  // namespace glissade::core
