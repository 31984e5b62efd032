// A circle through the origin with the tangent t and the curvature k is k (u^2 + v^2) = 2 (t_x v - t_y u). Solved for v in the form
// that has the curvature in no denominator it holds of straight lines, too, and of arcs whose centres lie miles away.

#include "parts/curves/plumb.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace glissade::parts {
namespace {

constexpr double kSame = 1e-9;  // rounding: of a point at the end of a piece [m]

/// A piece seen from its first point.
struct Seen {
  Vec2 chord;      ///< unit
  double length;   ///< of the chord [m]
  Vec2 tangent;    ///< unit, where the piece begins
  double k = 0.0;  ///< curvature, positive to the left [1/m]
};

Seen seen(const PathPiece& piece) {
  const Vec2 away = piece.to - piece.from;
  Seen one;
  one.length = norm(away);
  one.chord = (1.0 / one.length) * away;
  const double b = piece.bulge;
  const double cosine = (1.0 - b * b) / (1.0 + b * b);  // of half the sweep
  const double sine = 2.0 * b / (1.0 + b * b);
  one.tangent = {one.chord.x * cosine + one.chord.y * sine, one.chord.y * cosine - one.chord.x * sine};
  one.k = 4.0 * b / (one.length * (1.0 + b * b));
  return one;
}

/// Whether a point of the circle or line of a piece lies on the piece.
bool reaches(const PathPiece& piece, const Seen& one, Vec2 point) {
  const double along = dot(point, one.chord);
  if (along < -kSame || along > one.length + kSame) return false;
  return piece.straight() || (piece.bulge > 0.0 ? -1.0 : 1.0) * cross(one.chord, point) >= -kSame;
}

/// Both heights of the circle of a piece so far beside its first point, or the one of its line.
std::array<std::optional<double>, 2> heights_beside(const Seen& one, double u) {
  const double free = u * (one.k * u + 2.0 * one.tangent.y);
  const double square = one.tangent.x * one.tangent.x - one.k * free;
  if (square < 0.0) return {};
  const double q = one.tangent.x + std::copysign(std::sqrt(square), one.tangent.x);
  std::array<std::optional<double>, 2> heights;
  if (q != 0.0) heights[0] = free / q;
  if (one.k != 0.0) heights[1] = q / one.k;
  return heights;
}

}  // namespace

std::optional<double> level_below(const ArcPath& line, Vec2 point) {
  std::optional<double> highest;
  const auto see = [&](double level) {
    if (level <= point.y && (!highest || level > *highest)) highest = level;
  };
  for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i) {
    const PathPiece piece{line.vertices[i].at, line.vertices[i + 1].at, line.vertices[i].bulge};
    if (piece.from == piece.to) continue;
    const Seen one = seen(piece);
    const double u = point.x - piece.from.x;
    for (const std::optional<double> v : heights_beside(one, u)) {
      if (v && reaches(piece, one, {u, *v})) see(piece.from.y + *v);
    }
  }
  return highest;
}

std::optional<double> place_at_run(const ArcSpline& track, double x, double about) {
  std::optional<double> nearest;
  for (const TrackArc& arc : track.arcs()) {
    double low = arc.start;
    double high = arc.start + arc.length;
    if (!(track.at(low).x <= x + kSame && track.at(high).x >= x - kSame)) continue;
    constexpr int kRounds = 60;  // rounding: down to it
    for (int round = 0; round < kRounds; ++round) {
      const double middle = 0.5 * (low + high);
      (track.at(middle).x < x ? low : high) = middle;
    }
    if (!nearest || std::fabs(high - about) < std::fabs(*nearest - about)) nearest = high;
  }
  return nearest;
}

}  // namespace glissade::parts
