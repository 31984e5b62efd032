#pragma once

#include "glissade/centerline/centerline.hpp"

#include <vector>

namespace testing {

/// Stations of a track for a strip: as many on each of its smooth parts, and its end.
inline std::vector<glissade::CenterlinePoint> stations_of(const glissade::Centerline& track, int samples) {
  std::vector<glissade::CenterlinePoint> stations;
  const std::vector<double> breaks = track.breaks();
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    for (int k = 0; k < samples; ++k) {
      stations.push_back(track.at(breaks[i] + (breaks[i + 1] - breaks[i]) * k / samples));
    }
  }
  stations.push_back(track.at(breaks.back()));
  return stations;
}

}  // namespace testing
