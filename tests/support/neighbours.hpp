#pragma once

#include "glissade/centerline/clothoid_spline.hpp"

#include "support/random.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace testing {

/// A track with its curvature changed a little and turned and scaled so that it ends where the other does.
inline glissade::CenterlinePtr neighbour(const glissade::ClothoidSpline& track, Random& random, double size) {
  std::vector<glissade::ClothoidSegment> segments = track.segments();
  const double scale = size / track.length();
  const double wave = random.between(0.0, 4.0);
  const double phase = random.between(0.0, 6.3);
  double s = 0.0;
  const auto change = [&](double at) {
    return scale * std::cos(phase + wave * std::numbers::pi * at / track.length());
  };
  for (glissade::ClothoidSegment& segment : segments) {
    segment.entry_curvature += change(s);
    s += segment.length;
    segment.exit_curvature += change(s);
  }
  const glissade::ClothoidSpline bent(track.entry_slope_angle(), segments);
  const glissade::Endpoints from = bent.endpoints();
  const glissade::Endpoints to = track.endpoints();
  const double stretch = std::hypot(to.run, to.drop) / std::hypot(from.run, from.drop);
  const double turn = std::atan2(to.drop, to.run) - std::atan2(from.drop, from.run);
  for (glissade::ClothoidSegment& segment : segments) {
    segment.length *= stretch;
    segment.entry_curvature /= stretch;
    segment.exit_curvature /= stretch;
  }
  return std::make_shared<const glissade::ClothoidSpline>(
      glissade::Angle::from_radians(track.entry_slope_angle().radians() + turn), segments);
}

}  // namespace testing
