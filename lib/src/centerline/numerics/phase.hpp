#pragma once

#include "glissade/core/math.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace glissade::centerline {

/// A phase phi in (0, pi) with the trigonometry and the two integrals that the closed forms need, all of them
/// accurate relative to their own size at both ends of the range:
///
///     P = (phi - sin phi cos phi)/sin phi            = (2/sin phi) Int sin^2
///     Q = 2 sin^2 phi - 3 P cos phi                  = (3/sin phi) Int P sin^2
struct Phase {
  double angle = 0.0;  ///< phi [rad]
  double sine = 0.0;
  double cosine = 0.0;
  double first_integral = 0.0;   ///< P
  double second_integral = 0.0;  ///< Q
};

/// Below this phase P and Q come from their power series: the closed forms lose digits there.
inline constexpr double kSeriesPhase = 0.6;
inline constexpr std::size_t kSeriesTerms = 11;
using PhaseSeries = std::array<double, kSeriesTerms>;

/// @return coefficients of (phi - sin phi cos phi)/phi^3 in powers of phi^2
constexpr PhaseSeries first_integral_series() {
  PhaseSeries series{};
  double term = 4.0 / 6.0;  // 2^(2k)/(2k + 1)!, alternating, from k = 1
  for (std::size_t i = 0; i < kSeriesTerms; ++i) {
    series[i] = term;
    const double order = 2.0 * static_cast<double>(i + 1);
    term *= -4.0 / ((order + 2.0) * (order + 3.0));
  }
  return series;
}

/// @return coefficients of (sin phi) Q / phi^5 = [(9 sin phi + sin 3 phi)/4 - 3 phi cos phi]/phi^5 in powers
///         of phi^2
constexpr PhaseSeries second_integral_series() {
  PhaseSeries series{};
  double power_of_three = 243.0;  // 3^(2k + 1), from k = 2
  double factorial = 120.0;       // (2k + 1)!
  double sign = 1.0;
  for (std::size_t i = 0; i < kSeriesTerms; ++i) {
    const double order = 2.0 * static_cast<double>(i + 2);
    series[i] = sign * ((9.0 + power_of_three) / 4.0 - 3.0 * (order + 1.0)) / factorial;
    power_of_three *= 9.0;
    factorial *= (order + 2.0) * (order + 3.0);
    sign = -sign;
  }
  return series;
}

inline double series_value(const PhaseSeries& series, double variable) {
  double sum = 0.0;
  for (std::size_t i = kSeriesTerms; i-- > 0;) sum = sum * variable + series[i];
  return sum;
}

/// @param half_tangent  tan(phi/2); > 0
inline Phase phase_at(double half_tangent) {
  constexpr PhaseSeries kFirst = first_integral_series();
  constexpr PhaseSeries kSecond = second_integral_series();
  Phase phase;
  const double norm = 1.0 / (1.0 + half_tangent * half_tangent);
  phase.angle = 2.0 * math::atan(half_tangent);
  phase.sine = 2.0 * half_tangent * norm;
  phase.cosine = (1.0 - half_tangent) * (1.0 + half_tangent) * norm;
  if (phase.angle < kSeriesPhase) {
    const double square = phase.angle * phase.angle;
    const double ratio = phase.angle / phase.sine;
    phase.first_integral = series_value(kFirst, square) * square * ratio;
    phase.second_integral = series_value(kSecond, square) * square * square * ratio;
  } else {
    phase.first_integral = phase.angle / phase.sine - phase.cosine;
    phase.second_integral = 2.0 * phase.sine * phase.sine - 3.0 * phase.cosine * phase.first_integral;
  }
  return phase;
}

}  // namespace glissade::centerline
