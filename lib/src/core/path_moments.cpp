#include "glissade/core/arc_path.hpp"
#include "glissade/core/math.hpp"

#include <cmath>
#include <numbers>

namespace glissade {
namespace {

/// Below this sweep the differences of the closed forms would lose digits, and their series end soon.
constexpr double kSmallSweep = 0.3;

/// Area between an arc of this sweep and its chord, over the square of the chord:
/// (sweep - sin(sweep)) / (4 (1 - cos(sweep))).
double segment_area_factor(double sweep) {
  if (std::fabs(sweep) > kSmallSweep) {
    return (sweep - math::sin(sweep)) / (4.0 * (1.0 - math::cos(sweep)));
  }
  const double q = sweep * sweep;
  const double above = 1.0 / 6 - q * (1.0 / 120 - q * (1.0 / 5040 - q * (1.0 / 362880 - q / 39916800)));
  const double below = 2.0 - q * (1.0 / 6 - q * (1.0 / 180 - q * (1.0 / 10080 - q / 907200)));
  return sweep * above / below;
}

/// First moment of that area about the chord, over the cube of the chord: 1/12 (about the arc's centre) less the area
/// times the centre's distance from the chord.
double segment_moment_factor(double sweep, double area_factor, double to_centre) {
  if (std::fabs(sweep) > kSmallSweep) return 1.0 / 12 - area_factor * to_centre;
  const double q = sweep * sweep;
  return q * (1.0 / 240 + q * (1.0 / 4032 + q * (1.0 / 86400 + q * (1.0 / 2128896 + q * 691 / 39626496000))));
}

/// Area and first moment about `origin` of what lies between a piece, seen from `origin`, and `origin`.
struct SignedMoments {
  double area = 0.0;
  Vec2 first;
};

SignedMoments moments_of(const PathPiece& piece, Vec2 origin) {
  const Vec2 a = piece.from - origin;
  const Vec2 b = piece.to - origin;
  const double triangle = 0.5 * cross(a, b);
  SignedMoments sum{triangle, (triangle / 3.0) * (a + b)};
  if (piece.straight()) return sum;
  const Vec2 along = b - a;
  const double chord = norm(along);
  const double sweep = 4.0 * math::atan(piece.bulge);
  const double factor = segment_area_factor(sweep);
  const double area = chord * chord * factor;
  const double to_centre = (1.0 - piece.bulge * piece.bulge) / (4.0 * piece.bulge);
  // Towards the arc's middle it is to the right of a left turn; `outward` has the length of the chord.
  const double beyond_chord = chord * chord * segment_moment_factor(sweep, factor, to_centre);
  const Vec2 outward{along.y, -along.x};
  sum.area += area;
  sum.first = sum.first + area * (0.5 * (a + b)) + beyond_chord * outward;
  return sum;
}

SignedMoments moments_of(const ArcPath& path, Vec2 origin) {
  SignedMoments sum;
  for (const PathPiece& piece : pieces_of(path)) {
    const SignedMoments part = moments_of(piece, origin);
    sum.area += part.area;
    sum.first = sum.first + part.first;
  }
  return sum;
}

}  // namespace

double signed_area(const ArcPath& path) {
  return path.vertices.empty() ? 0.0 : moments_of(path, path.vertices.front().at).area;
}

AreaMoments moments(const PlaneRegion& region) {
  if (region.outline.vertices.empty()) return {};
  const Vec2 origin = region.outline.vertices.front().at;
  SignedMoments sum;
  const auto add = [&](const SignedMoments& part, double sign) {
    const double outward = part.area < 0.0 ? -sign : sign;
    sum.area += outward * part.area;
    sum.first = sum.first + outward * part.first;
  };
  add(moments_of(region.outline, origin), 1.0);
  for (const ArcPath& cutout : region.cutouts) add(moments_of(cutout, origin), -1.0);
  for (const Circle& hole : region.holes) {
    const double area = std::numbers::pi * hole.radius * hole.radius;
    add({area, area * (hole.centre - origin)}, -1.0);
  }
  return {sum.area, origin + (sum.area != 0.0 ? 1.0 / sum.area : 0.0) * sum.first};
}

}  // namespace glissade
