#include "pipeline/ride/extremes.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

#include <boost/math/tools/minima.hpp>

namespace glissade::pipeline {
namespace {

using Quantity = std::function<double(double s)>;

/// Highest value on one smooth stretch: sampled, then refined around the highest sample.
Extreme highest_between(double from, double to, const Quantity& quantity) {
  constexpr int kSamples = 64;
  constexpr int kBits = 26;  // a maximum is flat: half of the digits in s are all of those in the value
  // Right at `to` the values of the next stretch hold.
  const double last = std::nextafter(to, from);
  const auto station = [&](int index) {
    return index == kSamples ? last : from + (to - from) * index / kSamples;
  };
  int highest_index = 0;
  double highest = quantity(from);
  for (int index = 1; index <= kSamples; ++index) {
    const double here = quantity(station(index));
    if (here > highest) {
      highest = here;
      highest_index = index;
    }
  }
  const double left = station(std::max(highest_index - 1, 0));
  const double right = station(std::min(highest_index + 1, kSamples));
  // In shares of the bracket: the search ends at a part of the number it is at, and that part of an arc length is much
  // of a short stretch far along a track.
  const auto place = [&](double share) { return std::lerp(left, right, share); };
  const auto [share, lowest] =
      boost::math::tools::brent_find_minima([&](double at) { return -quantity(place(at)); }, 0.0, 1.0, kBits);
  if (-lowest > highest) return {-lowest, place(share)};
  return {highest, station(highest_index)};
}

}  // namespace

Extreme highest_along(const std::vector<double>& breaks, const Quantity& quantity) {
  Extreme highest{-std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t index = 1; index < breaks.size(); ++index) {
    const Extreme here = highest_between(breaks[index - 1], breaks[index], quantity);
    if (here.value > highest.value) highest = here;
  }
  return highest;
}

Extreme highest_along(const Centerline& centerline, const Quantity& quantity) {
  return highest_along(centerline.breaks(), quantity);
}

Extreme highest_radial_acceleration(const Motion& motion) {
  const QuantityPeak peak = motion.highest(
      [&](const LawState& at) { return at.normal_load - motion.gravity() * math::cos(at.slope_angle); });
  return {peak.value, peak.arc_length};
}

double smallest_radius(const Centerline& centerline) {
  if (centerline.unbounded_curvature_at_start()) return 0.0;
  const double sharpest =
      highest_along(centerline, [&](double s) { return std::fabs(centerline.at(s).curvature); }).value;
  return sharpest == 0.0 ? std::numeric_limits<double>::infinity() : 1.0 / sharpest;
}

Angle steepest_slope_angle(const Centerline& centerline) {
  return Angle::from_radians(
      highest_along(centerline, [&](double s) { return centerline.slope_angle(s); }).value);
}

}  // namespace glissade::pipeline
