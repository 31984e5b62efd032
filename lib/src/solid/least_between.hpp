#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include <boost/math/tools/minima.hpp>

namespace glissade::solid {

/// The least value of a function of the arc length between two places that bracket it.
///
/// Looked for in shares of the bracket: Brent's search ends at a part of the number it is at, and that part of an arc
/// length is more than a whole facet far along a track.
/// Accuracy: 2^(1 - bits) of the bracket in the place at most, which of a parabola's height is the square of it.
/// @return the place and the value there
template <typename Function>
[[nodiscard]] std::pair<double, double> least_between(double low, double high, int bits,
                                                      std::uintmax_t iterations, const Function& function) {
  const auto place = [&](double share) { return std::lerp(low, high, share); };
  const auto [share, least] = boost::math::tools::brent_find_minima(
      [&](double at) { return function(place(at)); }, 0.0, 1.0, bits, iterations);
  return {place(share), least};
}

}  // namespace glissade::solid
