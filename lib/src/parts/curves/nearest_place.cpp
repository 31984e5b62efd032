#include "parts/curves/nearest_place.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace glissade::parts {
namespace {

/// How far along an arc the foot of a point lies, seen from a place of it; beyond the ends where it is not on the arc.
double foot_along(const TrackFrame& from, double curvature, double length, Vec2 point) {
  const Vec2 away = point - from.at;
  const double ahead = dot(away, from.along);
  if (curvature == 0.0) return ahead;
  double turned = math::atan2(curvature * ahead, 1.0 - curvature * dot(away, from.up));
  const double turn = 2.0 * std::numbers::pi;
  turned -= turn * std::nearbyint((turned - 0.5 * curvature * length) / turn);
  return turned / curvature;
}

}  // namespace

TrackPlace nearest_place(const ArcSpline& track, const Span& span, Vec2 point) {
  TrackPlace best{span.from, std::numeric_limits<double>::infinity()};
  const auto take = [&](double s) {
    const double away = norm(frame_at(track, s).at - point);
    if (away < best.distance) best = {s, away};
  };
  for (std::size_t i = track.arc_at(span.from); i < track.arcs().size(); ++i) {
    const TrackArc& arc = track.arcs()[i];
    if (arc.start > span.to) break;
    // No place of an arc is farther from its start than it is long.
    if (norm(track.path().vertices[i].at - point) - arc.length > best.distance) continue;
    const double from = std::max(span.from, arc.start);
    const double to = std::min(span.to, arc.start + arc.length);
    const double along = foot_along(frame_at(track, from), arc.curvature, to - from, point);
    if (along > 0.0 && along < to - from) {
      take(from + along);
    } else {
      take(from);
      take(to);
    }
  }
  return best;
}

}  // namespace glissade::parts
