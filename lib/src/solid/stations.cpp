#include "solid/stations.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace glissade::solid {
namespace {

// The fewest steps of a track: end faces and creases need something between them.
constexpr double kFewestSteps = 8.0;
// Curvature is read off differences of the slope angle over panels no longer than this share of the track.
constexpr double kLongestPanel = 1.0 / 64.0;
constexpr int kDeepestPanel = 40;
// Halves of a panel that agree with the whole to this share end its refinement.
constexpr double kPanelAgreement = 0.05;

}  // namespace

Station station_at(const Centerline& centerline, double s) {
  const CenterlinePoint at = centerline.at(s);
  const auto [sine, cosine] = math::sine_cosine(at.slope_angle);
  return {s, {at.x, -at.drop}, {cosine, -sine}, {sine, cosine}, at.slope_angle, at.curvature};
}

StationPlan::StationPlan(const Centerline& centerline, const StationLimits& limits)
    : centerline_(centerline), limits_(limits) {
  const std::vector<double> breaks = centerline.breaks();
  double begin = breaks.front();
  double begin_slope = centerline.slope_angle(begin);
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double end = breaks[i];
    const double end_slope = centerline.slope_angle(end);
    spread(begin, begin_slope, end, end_slope, 0);
    begin = end;
    begin_slope = end_slope;
  }
  if (steps_ >= kFewestSteps) return;
  const double scale = kFewestSteps / steps_;
  for (Panel& panel : panels_) panel.steps *= scale;
  steps_ = kFewestSteps;
}

double StationPlan::steps_of(double length, double turn) const {
  const double angle = std::fabs(turn);
  const double outer = turn > 0.0 ? limits_.below : limits_.above;
  const double chord_error = 0.125 * angle * (length + angle * outer);
  return std::max({length / limits_.longest, angle / limits_.largest_turn,
                   std::sqrt(chord_error / limits_.chord_tolerance)});
}

void StationPlan::spread(double begin, double begin_slope, double end, double end_slope, int depth) {
  if (!(end > begin)) return;
  const double middle = 0.5 * (begin + end);
  const double middle_slope = centerline_.slope_angle(middle);
  const double whole = steps_of(end - begin, begin_slope - end_slope);
  const double first = steps_of(middle - begin, begin_slope - middle_slope);
  const double second = steps_of(end - middle, middle_slope - end_slope);
  const bool fine = end - begin <= kLongestPanel * centerline_.length() &&
                    std::fabs(first + second - whole) <= kPanelAgreement * whole &&
                    std::fabs(first - second) <= 0.5 * whole;
  if (fine || depth >= kDeepestPanel || whole + first + second < 1e-3) {
    panels_.push_back({begin, middle, first});
    panels_.push_back({middle, end, second});
    steps_ += first + second;
    return;
  }
  spread(begin, begin_slope, middle, middle_slope, depth + 1);
  spread(middle, middle_slope, end, end_slope, depth + 1);
}

std::vector<Station> StationPlan::stations() const {
  const double length = centerline_.length();
  const auto count = static_cast<std::size_t>(std::ceil(steps_));
  std::vector<Station> stations;
  stations.reserve(count + 1);
  stations.push_back(station_at(centerline_, 0.0));
  const double step = steps_ / static_cast<double>(count);
  double before = 0.0;
  std::size_t next = 1;
  for (const Panel& panel : panels_) {
    while (next < count && step * static_cast<double>(next) <= before + panel.steps) {
      const double part = (step * static_cast<double>(next) - before) / panel.steps;
      stations.push_back(station_at(centerline_, panel.begin + part * (panel.end - panel.begin)));
      ++next;
    }
    before += panel.steps;
  }
  stations.push_back(station_at(centerline_, length));
  meet_breaks(stations);
  return stations;
}

// Curvature may jump at a break, and the level curves with it: a station stands there, the nearest one moved
// or one more. Of breaks closer together than stations the last may do; those to be kept stay.
void StationPlan::meet_breaks(std::vector<Station>& stations) const {
  constexpr double kNear = 0.35;
  const auto before = [](const Station& station, double s) { return station.s < s; };
  const auto stays = [&](const Station& station) {
    return std::binary_search(limits_.kept.begin(), limits_.kept.end(), station.s);
  };
  std::vector<Station> further;
  for (const double s : centerline_.breaks()) {
    const auto after = std::lower_bound(stations.begin(), stations.end(), s, before);
    if (after == stations.begin() || after == stations.end() || after->s == s) continue;
    const double step = after->s - (after - 1)->s;
    const double part = (s - (after - 1)->s) / step;
    if (part < kNear && after - 1 != stations.begin() && !stays(*(after - 1))) {
      *(after - 1) = station_at(centerline_, s);
    } else if (part > 1.0 - kNear && after + 1 != stations.end() && !stays(*after)) {
      *after = station_at(centerline_, s);
    } else {
      further.push_back(station_at(centerline_, s));
    }
  }
  std::vector<Station> merged(stations.size() + further.size());
  std::merge(stations.begin(), stations.end(), further.begin(), further.end(), merged.begin(),
             [](const Station& a, const Station& b) { return a.s < b.s; });
  stations = std::move(merged);
}

}  // namespace glissade::solid
