#pragma once

// Tracks and widths for property tests of plates.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/section/measures.hpp"

#include "support/random.hpp"

#include <algorithm>
#include <vector>

namespace testing {

/// What random tracks of bends one after the other are drawn from.
struct TrackRange {
  double smallest = 3.0;  ///< size, of which all lengths are shares [m]
  double largest = 12.0;
  int bends = 4;        ///< at most
  double crest = -0.8;  ///< curvatures times the size
  double valley = 1.2;
  double shortest = 0.1;  ///< bends, as shares of the size
  double longest = 0.4;
  double steepest = 60.0;  ///< at the start [deg], from 30 on
  bool fading = false;     ///< half of the bends end straight
};

inline glissade::ClothoidSpline random_track(Random& random, const TrackRange& range) {
  const double size = random.between(range.smallest, range.largest);
  std::vector<glissade::ClothoidSegment> segments;
  for (int i = random.integer(1, range.bends); i > 0; --i) {
    const double curvature = random.between(range.crest, range.valley) / size;
    const double length = random.between(range.shortest, range.longest) * size;
    const bool fades = range.fading && random.integer(0, 1) != 0;
    segments.push_back({length, curvature, fades ? 0.0 : curvature});
  }
  return {glissade::Angle::from_degrees(random.between(30.0, range.steepest)), segments};
}

/// Widths that change evenly between some places of a track.
inline std::vector<glissade::WidthAt> random_widths(Random& random, double length) {
  std::vector<glissade::WidthAt> knots;
  double at = random.between(0.0, 0.2) * length;
  double width = random.between(0.3, 0.8);
  for (int i = random.integer(2, 4); i > 0; --i) {
    knots.push_back({at, width});
    const double step = random.between(0.1, 0.3) * length;
    at += step;
    width = std::max(0.15, width + random.between(-0.15, 0.15) * step);
  }
  return knots;
}

}  // namespace testing
