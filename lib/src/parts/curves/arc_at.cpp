#include "parts/curves/arc_at.hpp"

#include "glissade/core/math.hpp"

#include <cmath>
#include <numbers>

namespace glissade::parts {

double sinc(double x) {
  return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : math::sin(x) / x;
}

double wrapped(double angle) {
  const double turn = 2.0 * std::numbers::pi;
  return angle - turn * std::nearbyint(angle / turn);
}

Vec2 direction_of(double heading) {
  const auto [sine, cosine] = math::sine_cosine(heading);
  return {cosine, sine};
}

double ArcAt::distance(Vec2 point) const {
  return distance_from(from, direction_of(heading), curvature, point);
}

ArcAt ArcAt::after(double length) const {
  const double half = 0.5 * curvature * length;
  return {from + (length * sinc(half)) * direction_of(heading + half), heading + 2.0 * half, curvature};
}

// Both centres and the place that is touched lie on one line: C - T = N/k, O - T = N/kappa. Multiplied by k and kappa, so
// that either may be 0.

TouchingCurvature touching_curvature(const ArcAt& from, const ArcAt& other) {
  const Vec2 away = from.from - other.from;
  const double half_turn = math::sin(0.5 * wrapped(other.heading - from.heading));
  return {other.curvature * dot(away, left_of(direction_of(from.heading))) + 2.0 * half_turn * half_turn,
          0.5 * other.curvature * dot(away, away) - dot(away, left_of(direction_of(other.heading)))};
}

std::optional<Touching> touching(const ArcAt& from, const ArcAt& other) {
  const Vec2 away = from.from - other.from;
  const Vec2 normal = left_of(direction_of(from.heading));
  const Vec2 other_normal = left_of(direction_of(other.heading));
  const double kappa = other.curvature;
  Touching found{from, 0.0, 0.0};
  const double k = touching_curvature(from, other).value();
  if (!std::isfinite(k) || k == 0.0 || k == kappa) return std::nullopt;
  found.leg.curvature = k;
  const Vec2 at_touch = (1.0 / (kappa - k)) * ((k * kappa) * away + kappa * normal - k * other_normal);
  const double heading = math::atan2(-at_touch.x, at_touch.y);
  found.length = wrapped(heading - from.heading) / k;
  if (!(found.length > 0.0) || std::fabs(found.length * k) > 0.5 * std::numbers::pi) return std::nullopt;
  const Vec2 chord = found.leg.after(found.length).from - other.from;
  const double half = 0.5 * wrapped(heading - other.heading);
  const double size = norm(chord) / sinc(half);
  found.beyond = dot(chord, direction_of(other.heading + half)) < 0.0 ? -size : size;
  return found;
}

Vec2 biarc_joint(Vec2 from, double heading, Vec2 to, double end_heading, double share) {
  // Joints lie on the circle through both ends that makes equal angles with both tangents (K. M. Bolton, CAD 1975).
  const Vec2 chord = to - from;
  const double chord_angle = math::atan2(chord.y, chord.x);
  const double lean = 0.5 * (wrapped(heading - chord_angle) - wrapped(end_heading - chord_angle));
  // From the end of the locus: its centre may be far away.
  const double distance = norm(chord) * share * sinc(lean * share) / sinc(lean);
  return from + distance * direction_of(chord_angle + lean * (1.0 - share));
}

}  // namespace glissade::parts
