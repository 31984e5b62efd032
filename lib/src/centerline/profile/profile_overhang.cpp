#include "centerline/profile/profile_overhang.hpp"

#include "glissade/core/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace glissade::centerline {
namespace {

/// The shares of a segment at which its slope angle passes another, ascending; 0 and 1 before and behind them.
std::vector<double> parts_at(double slope, const ClothoidSegment& segment) {
  std::vector<double> parts = {0.0, 1.0};
  const double turn = segment.entry_curvature * segment.length;
  const double change = 0.5 * (segment.exit_curvature - segment.entry_curvature) * segment.length;
  for (const double limit : {kRightAngle, -kRightAngle}) {
    // slope - turn u - change u^2 = limit, by the root that loses no digits
    const double rest = slope - limit;
    const double square = turn * turn + 4.0 * change * rest;
    if (square < 0.0) continue;
    const double half = 0.5 * (turn + std::copysign(std::sqrt(square), turn));
    for (const double u : {half != 0.0 ? rest / half : 0.0, change != 0.0 ? -half / change : 0.0})
      if (u > 0.0 && u < 1.0) parts.push_back(u);
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

}  // namespace

double beyond_vertical(const ClothoidSpline& curve) {
  double most = std::fabs(curve.slope_angle(0.0));
  for (const double s : curve.breaks()) most = std::max(most, std::fabs(curve.slope_angle(s)));
  return most - kRightAngle;
}

FittedCurve not_overhanging(FittedCurve found) {
  if (beyond_vertical(found.curve) <= 0.0) return found;
  const double entry = found.curve.slope_angle(0.0);
  std::vector<ClothoidSegment> segments;
  double slope = entry;
  double overhanging = 0.0;  // integral of where that is
  double length = 0.0;
  double s = 0.0;
  for (const ClothoidSegment& whole : found.curve.segments()) {
    const std::vector<double> parts = parts_at(slope, whole);
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
      const double change = whole.exit_curvature - whole.entry_curvature;
      const double u = 0.5 * (parts[k] + parts[k + 1]);
      const double here = slope - whole.length * u * (whole.entry_curvature + 0.5 * change * u);
      ClothoidSegment part{(parts[k + 1] - parts[k]) * whole.length,
                           whole.entry_curvature + change * parts[k],
                           whole.entry_curvature + change * parts[k + 1]};
      if (!(part.length > 0.0)) continue;
      if (std::fabs(here) > kRightAngle) {
        part.entry_curvature = part.exit_curvature = 0.0;
        overhanging += part.length * (s + u * whole.length);
        length += part.length;
      }
      segments.push_back(part);
    }
    slope -= 0.5 * (whole.entry_curvature + whole.exit_curvature) * whole.length;
    s += whole.length;
  }
  ClothoidSpline curve(Angle::from_radians(std::clamp(entry, -kRightAngle, kRightAngle)),
                       std::move(segments));
  if (overhanging < 0.5 * s * length) {
    const CenterlinePoint before = found.curve.at(found.curve.length());
    const CenterlinePoint after = curve.at(curve.length());
    found.start = found.start + Vec2{before.x - after.x, before.drop - after.drop};
  }
  found.curve = std::move(curve);
  return found;
}

}  // namespace glissade::centerline
