#include "glissade/core/arc_path.hpp"

#include "glissade/core/math.hpp"

#include "core/arc_pieces.hpp"

#include <algorithm>
#include <cmath>

namespace glissade {

PlaneMotion PlaneMotion::turn(double angle, Vec2 shift) {
  const auto [sine, cosine] = math::sine_cosine(angle);
  return {cosine, sine, shift, false};
}

Vec2 PlaneMotion::operator()(Vec2 point) const {
  const Vec2 p{point.x, mirrored ? -point.y : point.y};
  return Vec2{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y} + shift;
}

double bulge_of_sweep(double sweep) {
  return math::tan(0.25 * sweep);
}

CircularArc arc_of(const PathPiece& piece) {
  const Circle circle = core::circle_of(piece);
  CircularArc arc;
  arc.radius = circle.radius;
  arc.centre = circle.centre;
  arc.start_angle = math::atan2(piece.from.y - arc.centre.y, piece.from.x - arc.centre.x);
  arc.sweep = 4.0 * math::atan(piece.bulge);
  return arc;
}

std::vector<PathPiece> pieces_of(const ArcPath& path) {
  std::vector<PathPiece> pieces;
  const std::size_t count = path.vertices.size();
  if (count < 2) return pieces;
  const std::size_t last = path.closed ? count : count - 1;
  pieces.reserve(last);
  for (std::size_t i = 0; i < last; ++i) {
    const PathVertex& vertex = path.vertices[i];
    pieces.push_back({vertex.at, path.vertices[(i + 1) % count].at, vertex.bulge});
  }
  return pieces;
}

Vec2 point_on(const PathPiece& piece, double share) {
  if (piece.straight()) return piece.from + share * (piece.to - piece.from);
  // From the chord, so that nearly straight arcs lose nothing to their far centre.
  const double half = 2.0 * math::atan(piece.bulge);
  const double first = half * share;
  const double size = math::sin(first) / math::sin(half);
  const auto [sine, cosine] = math::sine_cosine(first - half);
  const Vec2 along = piece.to - piece.from;
  return piece.from + size * Vec2{cosine * along.x - sine * along.y, sine * along.x + cosine * along.y};
}

double length(const PathPiece& piece) {
  const double chord = norm(piece.to - piece.from);
  if (piece.straight()) return chord;
  const double b = std::fabs(piece.bulge);
  return chord * (1.0 + b * b) * (math::atan(b) / b);
}

double length(const ArcPath& path) {
  double sum = 0.0;
  for (const PathPiece& piece : pieces_of(path)) sum += length(piece);
  return sum;
}

PlaneBox bounds(const ArcPath& path) {
  PlaneBox box = core::empty_box();
  for (const PathVertex& vertex : path.vertices) core::widen(box, vertex.at);
  for (const PathPiece& piece : pieces_of(path)) {
    if (piece.straight()) continue;
    const PlaneBox part = core::bounds_of(piece);
    core::widen(box, part.low);
    core::widen(box, part.high);
  }
  return box;
}

ArcPath reversed(const ArcPath& path) {
  ArcPath result{{}, path.closed};
  const std::size_t count = path.vertices.size();
  for (std::size_t i = 0; i < count; ++i) {
    // The piece after vertex k, run backwards, is the one that led to it.
    const std::size_t k = count - 1 - i;
    const std::size_t before = (k + count - 1) % count;
    result.vertices.push_back({path.vertices[k].at, -path.vertices[before].bulge + 0.0});
  }
  return result;
}

ArcPath moved(const ArcPath& path, const PlaneMotion& motion) {
  ArcPath result{{}, path.closed};
  result.vertices.reserve(path.vertices.size());
  for (const PathVertex& vertex : path.vertices) {
    result.vertices.push_back({motion(vertex.at), motion.mirrored ? -vertex.bulge + 0.0 : vertex.bulge});
  }
  return result;
}

PlaneRegion moved(const PlaneRegion& region, const PlaneMotion& motion) {
  PlaneRegion result{moved(region.outline, motion), {}, {}};
  for (const ArcPath& cutout : region.cutouts) result.cutouts.push_back(moved(cutout, motion));
  for (const Circle& hole : region.holes) result.holes.push_back({motion(hole.centre), hole.radius});
  return result;
}

ArcPath scaled(const ArcPath& path, double factor) {
  ArcPath result = path;
  for (PathVertex& vertex : result.vertices) vertex.at = factor * vertex.at;
  return result;
}

PlaneRegion scaled(const PlaneRegion& region, double factor) {
  PlaneRegion result{scaled(region.outline, factor), {}, region.holes};
  for (const ArcPath& cutout : region.cutouts) result.cutouts.push_back(scaled(cutout, factor));
  for (Circle& hole : result.holes) hole = {factor * hole.centre, factor * hole.radius};
  return result;
}

ArcPath path_of(const Circle& circle) {
  const Vec2 across{circle.radius, 0.0};
  return {{{circle.centre - across, 1.0}, {circle.centre + across, 1.0}}, true};
}

ArcPath rectangle(Vec2 low, Vec2 high) {
  return {{{low}, {{high.x, low.y}}, {high}, {{low.x, high.y}}}, true};
}

std::vector<Vec2> flattened(const ArcPath& path, double sagitta) {
  std::vector<Vec2> points;
  const std::vector<PathPiece> pieces = pieces_of(path);
  if (pieces.empty()) return points;
  points.push_back(pieces.front().from);
  for (const PathPiece& piece : pieces) {
    std::size_t steps = 1;
    if (!piece.straight()) {
      const CircularArc arc = arc_of(piece);
      const double share = std::clamp(1.0 - sagitta / arc.radius, 0.0, 1.0);
      // Whatever is asked for, no arc becomes more than a few thousand chords.
      const double largest_step = std::max(2.0 * math::acos(share), 1e-3);
      steps = static_cast<std::size_t>(std::ceil(std::fabs(arc.sweep) / largest_step));
      steps = std::max<std::size_t>(steps, 1);
    }
    for (std::size_t i = 1; i < steps; ++i) {
      points.push_back(point_on(piece, static_cast<double>(i) / static_cast<double>(steps)));
    }
    points.push_back(piece.to);
  }
  return points;
}

}  // namespace glissade
