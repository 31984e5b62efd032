#include "report/ride_stations.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::report {

namespace {

std::vector<double> stations_to(const Centerline& centerline, double distance) {
  constexpr int kStations = 400;
  std::vector<double> stations;
  for (int i = 0; i <= kStations; ++i) {
    const double fraction = static_cast<double>(i) / kStations;
    stations.push_back(distance * math::pow(fraction, 1.5));
  }
  for (const double s : centerline.breaks()) {
    if (s < distance) stations.push_back(s);
  }
  std::sort(stations.begin(), stations.end());
  const double least_gap = 1e-9 * distance;
  std::vector<double> kept;
  for (const double s : stations) {
    if (kept.empty() || s - kept.back() > least_gap) kept.push_back(s);
  }
  kept.back() = distance;
  return kept;
}

}  // namespace

std::vector<double> ride_stations(const Motion& motion) {
  return stations_to(motion.centerline(), motion.distance());
}

std::vector<double> track_stations(const Centerline& centerline) {
  return stations_to(centerline, centerline.length());
}

}  // namespace glissade::report
