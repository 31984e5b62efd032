#include "parts/plates/section_outside.hpp"

#include "glissade/core/math.hpp"

#include "parts/bodies/body_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace glissade::parts {
namespace {

constexpr double kLevel = 1e-9;  // of heights that count as one [m]

Vec2 left_of(Vec2 along) {
  return {-along.y, along.x};
}

Vec2 unit(Vec2 v) {
  return (1.0 / norm(v)) * v;
}

/// A point moved to the left of both pieces that meet there.
Vec2 mitred(Vec2 at, Vec2 before, Vec2 after, double by) {
  const Vec2 a = left_of(before);
  const Vec2 b = left_of(after);
  return at + (by / (1.0 + dot(a, b))) * (a + b);
}

/// An end moved to the left, at the height that it had.
Vec2 level_end(Vec2 at, Vec2 along, double by) {
  const Vec2 moved = at + by * left_of(along);
  if (std::fabs(along.y) < 1e-12) return moved;
  return moved - ((moved.y - at.y) / along.y) * along;
}

/// The place of a piece at which a linear measure changes its sign: by halving, so that arcs are lines' equals.
template <typename Measure>
double share_where(const PathPiece& piece, Measure measure) {
  double low = 0.0;
  double high = 1.0;
  const bool rises = measure(piece.from) < 0.0;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    ((measure(point_on(piece, middle)) < 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// A stretch of a piece, as the vertex that it begins with.
PathVertex part_of(const PathPiece& piece, double from, double to) {
  const double sweep = 4.0 * math::atan(piece.bulge);
  return {point_on(piece, from), piece.straight() ? 0.0 : bulge_of_sweep((to - from) * sweep)};
}

/// An open line from the first place at which a measure is negative on.
template <typename Measure>
ArcPath from_where(const ArcPath& line, Measure measure) {
  const std::vector<PathPiece> pieces = pieces_of(line);
  ArcPath rest;
  for (const PathPiece& piece : pieces) {
    const bool begun = !rest.vertices.empty();
    if (!begun && measure(piece.from) >= 0.0 && measure(piece.to) >= 0.0) continue;
    const double from = begun || measure(piece.from) < 0.0 ? 0.0 : share_where(piece, measure);
    rest.vertices.push_back(part_of(piece, from, 1.0));
  }
  rest.vertices.push_back({line.vertices.back().at, 0.0});
  return rest;
}

}  // namespace

ArcPath moved_out(const ArcPath& line, double by) {
  const std::vector<PathPiece> pieces = pieces_of(line);
  const std::size_t count = line.vertices.size();
  ArcPath path = line;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 at = line.vertices[i].at;
    const bool first = !line.closed && i == 0;
    const bool last = !line.closed && i + 1 == count;
    const Vec2 before = first ? Vec2() : tangent_at(pieces[(i + pieces.size() - 1) % pieces.size()], 1.0);
    const Vec2 after = last ? Vec2() : tangent_at(pieces[i % pieces.size()], 0.0);
    path.vertices[i].at = first  ? level_end(at, after, by)
                          : last ? level_end(at, before, by)
                                 : mitred(at, before, after, by);
  }
  return path;
}

SectionOutside lowered(const SectionOutside& outside, double by) {
  if (!(by > 0.0)) return outside;
  const double left = outside.line.vertices.front().at.y - by;
  const double right = outside.line.vertices.back().at.y - by;
  const ArcPath ahead = from_where(outside.line, [&](Vec2 at) { return at.y - left; });
  SectionOutside cut;
  cut.line = reversed(from_where(reversed(ahead), [&](Vec2 at) { return at.y - right; }));
  const std::size_t gone = outside.line.vertices.size() - ahead.vertices.size();
  for (OutsideLap lap : outside.laps) {
    if (lap.corner <= gone || lap.corner - gone + 1 >= cut.line.vertices.size()) continue;
    lap.corner -= gone;
    cut.laps.push_back(lap);
  }
  return cut;
}

ArcPath left_half(const ArcPath& ring, double from) {
  // Opened on the right it goes over the top: the outside is on its left.
  const std::size_t count = ring.vertices.size();
  std::size_t first = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (ring.vertices[i].at.x < ring.vertices[first].at.x) first = i;
  }
  ArcPath open;
  for (std::size_t k = 0; k <= count; ++k) open.vertices.push_back(ring.vertices[(first + k) % count]);
  const auto right = [&](Vec2 at) { return from - at.x; };
  return reversed(from_where(reversed(from_where(open, right)), right));
}

ArcPath first_stretch(const ArcPath& line, double most) {
  ArcPath path;
  double left = most;
  for (const PathPiece& piece : pieces_of(line)) {
    const double whole = length(piece);
    const double share = std::min(1.0, left / whole);
    path.vertices.push_back(part_of(piece, 0.0, share));
    left -= whole;
    if (left > 0.0) continue;
    path.vertices.push_back({point_on(piece, share), 0.0});
    return path;
  }
  path.vertices.push_back({line.vertices.back().at, 0.0});
  return path;
}

SectionOutside mirrored(const SectionOutside& outside) {
  SectionOutside other;
  other.line = reversed(outside.line);
  for (PathVertex& vertex : other.line.vertices) {
    vertex.at.x = -vertex.at.x;
    vertex.bulge = -vertex.bulge;
  }
  const std::size_t count = outside.line.vertices.size();
  for (const OutsideLap& lap : outside.laps)
    other.laps.push_back({count - 1 - lap.corner, !lap.before, lap.reach, lap.thickness});
  return other;
}

std::optional<double> underside_at(const ArcPath& line, double x) {
  std::optional<double> lowest;
  const auto see = [&](double y) { lowest = std::min(y, lowest.value_or(y)); };
  for (const PathPiece& piece : pieces_of(line)) {
    const auto [low, high] = std::minmax(piece.from.x, piece.to.x);
    const double bow = std::fabs(piece.bulge) * norm(piece.to - piece.from);
    if (x < low - bow || x > high + bow) continue;
    if (piece.straight()) {
      if (x < low || x > high) continue;
      const double wide = piece.to.x - piece.from.x;
      see(wide == 0.0 ? std::min(piece.from.y, piece.to.y)
                      : piece.from.y + (x - piece.from.x) / wide * (piece.to.y - piece.from.y));
      continue;
    }
    const CircularArc arc = arc_of(piece);
    const double aside = x - arc.centre.x;
    if (std::fabs(aside) > arc.radius) continue;
    const double rise = std::sqrt(arc.radius * arc.radius - aside * aside);
    for (const double y : {arc.centre.y - rise, arc.centre.y + rise}) {
      const double turned = math::atan2(y - arc.centre.y, aside) - arc.start_angle;
      const double whole = 2.0 * std::numbers::pi;
      const double on = arc.sweep > 0.0 ? turned - whole * std::floor(turned / whole)
                                        : turned - whole * std::ceil(turned / whole);
      if (std::fabs(on) <= std::fabs(arc.sweep) + kLevel) see(y);
    }
  }
  return lowest;
}

namespace {

/// The numbers of a lap: where it begins, which way it goes, and which way is out of its plate.
struct LapWay {
  Vec2 corner;
  Vec2 along;
  Vec2 out;
};

LapWay way_of(const SectionOutside& outside, const OutsideLap& lap) {
  const std::vector<PathVertex>& line = outside.line.vertices;
  const std::size_t count = line.size();
  const Vec2 at = line[lap.corner].at;
  const Vec2 other = line[lap.before ? (lap.corner + count - 1) % count : (lap.corner + 1) % count].at;
  const Vec2 along = unit(at - other);
  return {at, along, lap.before ? left_of(along) : -1.0 * left_of(along)};
}

}  // namespace

std::vector<Vec2> lap_tips(const SectionOutside& outside) {
  std::vector<Vec2> tips;
  for (const OutsideLap& lap : outside.laps) {
    const LapWay way = way_of(outside, lap);
    const Vec2 tip = way.corner + lap.reach * way.along;
    tips.push_back(tip);
    tips.push_back(tip - lap.thickness * way.out);
    tips.push_back(way.corner - lap.thickness * way.out);
  }
  return tips;
}

std::optional<double> underside_of_laps(const SectionOutside& outside, double from, double to) {
  std::optional<double> lowest;
  const auto see = [&](double y) { lowest = std::min(y, lowest.value_or(y)); };
  for (const OutsideLap& lap : outside.laps) {
    const LapWay way = way_of(outside, lap);
    const Vec2 reach = lap.reach * way.along;
    const Vec2 in = lap.thickness * way.out;
    const std::array<Vec2, 4> corners = {way.corner, way.corner + reach, way.corner + reach - in,
                                         way.corner - in};
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i];
      const Vec2 b = corners[(i + 1) % corners.size()];
      if (a.x >= from && a.x <= to) see(a.y);
      for (const double x : {from, to}) {
        if ((a.x < x) != (b.x < x)) see(a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y));
      }
    }
  }
  return lowest;
}

std::optional<ArcPath> round_laps(const SectionOutside& outside, double gap) {
  const ArcPath plain = moved_out(outside.line, gap);
  ArcPath path = plain;
  path.vertices.clear();
  const std::size_t count = plain.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto lap = std::find_if(outside.laps.begin(), outside.laps.end(),
                                  [&](const OutsideLap& one) { return one.corner == i; });
    if (lap == outside.laps.end()) {
      path.vertices.push_back(plain.vertices[i]);
      continue;
    }
    const LapWay way = way_of(outside, *lap);
    const Vec2 tip = way.corner + (lap->reach + gap) * way.along + gap * way.out;
    const Vec2 inner = tip - (lap->thickness + 2.0 * gap) * way.out;
    // Back along the lap's inner face until the next side's own line.
    const Vec2 here = plain.vertices[i].at;
    const Vec2 there = plain.vertices[lap->before ? (i + 1) % count : (i + count - 1) % count].at;
    const double sine = cross(there - here, way.along);
    const double share = cross(inner - here, way.along) / sine;
    if (!(share > 0.0 && share < 0.9)) return std::nullopt;
    std::vector<Vec2> corners = {tip, inner, here + share * (there - here)};
    if (!lap->before) std::reverse(corners.begin(), corners.end());
    for (const Vec2 corner : corners) path.vertices.push_back({corner, 0.0});
  }
  return path;
}

}  // namespace glissade::parts
