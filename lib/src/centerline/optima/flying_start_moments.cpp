// With the phase phi of coulomb_laws.cpp and S(x) = sin(q x)/q, C(x) = cos(q x), sigma = Int dt/E, each point of
// the range lies at eta in [-sigma/2, sigma/2] from the middle of the phase, and
//
//     1/sqrt(E) = S_m C(eta) + C_m S(eta),   dt = E d(eta),   t - from = sqrt(E E_from) S(sigma/2 - eta)
//
// so that every integral is a sum of Int C^i S^j d(eta), i and j even. q^2 <= 0 changes sin into sinh and nothing
// else.
#include "centerline/optima/flying_start_moments.hpp"

#include "glissade/core/math.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace glissade::centerline {
namespace {

// Below it (of q^2 x^2) remainders of the sine come from their power series, above from their definition, which
// loses less than a digit there.
constexpr double kSeriesArgument = 4.0;
constexpr std::size_t kMomentTerms = 15;

/// @return S(x) = sin(q x)/q
double scaled_sine(double q2, double x) {
  const double q = std::sqrt(std::fabs(q2));
  const double angle = q * x;
  constexpr double kTiny = 1e-9;
  if (angle < kTiny) return x;
  return (q2 > 0.0 ? math::sin(angle) : math::sinh(angle)) / q;
}

/// @return x^order sum of (-argument)^k order!/(order + 2 k)! over k, divided by order!
double series_remainder(double argument, double power, int order) {
  double sum = 1.0;
  for (std::size_t k = kMomentTerms; k-- > 0;) {
    const double n = order + 2.0 * static_cast<double>(k);
    sum = 1.0 - argument / ((n + 1.0) * (n + 2.0)) * sum;
  }
  return power * sum;
}

/// @return (x - S(x))/q^2
double cubic_remainder(double q2, double x, double sine) {
  const double argument = q2 * x * x;
  if (std::fabs(argument) < kSeriesArgument) return series_remainder(argument, x * x * x / 6.0, 3);
  return (x - sine) / q2;
}

/// @return (S(x) - x + q^2 x^3/6)/q^4
double quintic_remainder(double q2, double x, double sine) {
  const double argument = q2 * x * x;
  const double cube = x * x * x;
  if (std::fabs(argument) < kSeriesArgument) return series_remainder(argument, cube * x * x / 120.0, 5);
  return ((sine - x) / q2 + cube / 6.0) / q2;
}

/// Int C^i S^j over [-sigma/2, sigma/2].
struct EvenIntegrals {
  double c2 = 0.0, s2 = 0.0, c4 = 0.0, c2s2 = 0.0, s4 = 0.0;
};

EvenIntegrals even_integrals(double q2, double sigma) {
  const double sine = scaled_sine(q2, sigma);
  const double double_sine = scaled_sine(q2, 2.0 * sigma);
  EvenIntegrals integrals;
  integrals.c2 = 0.5 * (sigma + sine);
  integrals.s2 = 0.5 * cubic_remainder(q2, sigma, sine);
  integrals.c4 = 0.375 * sigma + 0.5 * sine + 0.0625 * double_sine;
  integrals.c2s2 = 0.0625 * cubic_remainder(q2, 2.0 * sigma, double_sine);
  integrals.s4 =
      0.0625 * quintic_remainder(q2, 2.0 * sigma, double_sine) - 0.5 * quintic_remainder(q2, sigma, sine);
  return integrals;
}

/// The range in the phase: its width sigma, S and C of half of it, S_m and C_m of its middle.
struct PhaseRange {
  double width = 0.0;
  double half_sine = 0.0;
  double half_cosine = 0.0;
  double sine = 0.0;
  double cosine = 0.0;
};

PhaseRange phase_range(double mu, double q2, const SlopeEnd& from, const SlopeEnd& to) {
  const double sine_from = 1.0 / std::sqrt(from.e);
  const double sine_to = 1.0 / std::sqrt(to.e);
  const double cosine_from = (from.slope - mu) * sine_from;
  const double cosine_to = (to.slope - mu) * sine_to;
  const double sine = (to.slope - from.slope) * sine_from * sine_to;
  const double cosine = q2 * sine_from * sine_to + cosine_from * cosine_to;
  const double q = std::sqrt(std::fabs(q2));
  PhaseRange range;
  range.width = sine;
  constexpr double kTiny = 1e-9;
  if (q * sine > kTiny || cosine < 0.0) {
    range.width = (q2 > 0.0 ? math::atan2(q * sine, cosine) : math::asinh(q * sine)) / q;
  }
  if (cosine >= 0.0) {
    range.half_cosine = std::sqrt(0.5 * (1.0 + cosine));
    range.half_sine = sine / (2.0 * range.half_cosine);
    range.sine = (sine_from + sine_to) / (2.0 * range.half_cosine);
    range.cosine = (cosine_from + cosine_to) / (2.0 * range.half_cosine);
  } else {
    range.half_sine = std::sqrt(0.5 * (1.0 - cosine)) / q;
    range.half_cosine = sine / (2.0 * range.half_sine);
    range.sine = (cosine_to - cosine_from) / (2.0 * q2 * range.half_sine);
    range.cosine = (sine_from - sine_to) / (2.0 * range.half_sine);
  }
  return range;
}

}  // namespace

SlopeMoments slope_moments(double mu, double q2, const SlopeEnd& from, const SlopeEnd& to) {
  const PhaseRange range = phase_range(mu, q2, from, to);
  const EvenIntegrals even = even_integrals(q2, range.width);
  const double s2 = range.sine * range.sine;
  const double c2 = range.cosine * range.cosine;
  const double root = std::sqrt(from.e);
  SlopeMoments moments;
  moments.m1 = range.width;
  moments.m2 = s2 * even.c2 + c2 * even.s2;
  moments.m3 = s2 * s2 * even.c4 + 6.0 * s2 * c2 * even.c2s2 + c2 * c2 * even.s4;
  moments.k2 = root * (range.sine * range.half_sine * even.c2 - range.cosine * range.half_cosine * even.s2);
  moments.k3 = root * (range.sine * range.half_sine * (s2 * even.c4 + 3.0 * c2 * even.c2s2) -
                       range.cosine * range.half_cosine * (3.0 * s2 * even.c2s2 + c2 * even.s4));
  return moments;
}

}  // namespace glissade::centerline
