#include "optimize/search/held_places.hpp"

#include <algorithm>
#include <cmath>

namespace glissade::optimizer {

void HeldPlaces::add(double sigma, const Vector& knots) {
  constexpr double kClose = 0.02;  // taste
  if (!(sigma > 0.0 && sigma < 1.0)) return;
  // A place of a greatest value is known to half the digits: those that rounding makes are no reason to end elsewhere.
  constexpr int kBits = 24;  // rounding: half of a double's
  int exponent = 0;
  const double mantissa = std::frexp(sigma, &exponent);
  sigma = std::ldexp(std::round(std::ldexp(mantissa, kBits)), exponent - kBits);
  if (sigma >= knots.back()) return;
  const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, sigma);
  const double piece = *above - *(above - 1);
  for (double& place : places_) {
    if (std::fabs(place - sigma) > kClose * piece) continue;
    place = sigma;
    return;
  }
  places_.push_back(sigma);
}

bool is_highest_load(const LimitSpec& limit) {
  const bool load = limit.measure == Measure::normal_load || limit.measure == Measure::curvature_load;
  return load && limit.side > 0;
}

}  // namespace glissade::optimizer
