#include "glissade/centerline/constant_speed_curve.hpp"

#include "support/catch.hpp"

#include <cmath>

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace constant_speed_precision_test {

using namespace glissade;

namespace {

using Digits = boost::multiprecision::cpp_bin_float_100;

/// docs/theory.md (C3) to (C10) as they read, without care for cancellation: 100 digits have room for it.
/// Only psi at the finish comes from (C5), sin(psi_1) = e^(-b) sin(psi_0): e^(-b) can be smaller than any
/// digits.
struct PlainCurve {
  Digits entry_slope_angle, exit_slope_angle, length, exit_speed;
};

PlainCurve plain_curve(Endpoints endpoints, double coefficient, double gravity, double p_value) {
  const Digits mu = coefficient;
  const Digits p = p_value;
  const Digits delta = atan(mu);
  const Digits rate = gravity / (p * sin(delta));
  const Digits along = rate * (endpoints.run * cos(delta) + endpoints.drop * sin(delta));
  const Digits turned = rate * (endpoints.drop * cos(delta) - endpoints.run * sin(delta));
  const Digits psi = atan2(sin(turned), cos(turned) - exp(-along));
  const Digits psi_exit = asin(sin(psi) * exp(-along));
  return {psi + delta, psi_exit + delta, log(tan(psi / 2) / tan(psi_exit / 2)) / rate,
          sqrt(p * (1 - exp(-2 * mu * turned)))};
}

double relative_error(double value, const Digits& exact) {
  return std::abs(static_cast<double>(value / exact - 1));
}

}  // namespace

TEST_CASE(
    "constant-speed curve: 100-digit arithmetic confirms it from a vertical start to an all but straight "
    "line") {
  double worst = 0.0;
  for (const double mu : {0.01, 0.03, 0.2, 1.0, 3.0}) {
    for (const double excess : {1e-6, 1e-3, 0.1, 2.0, 300.0}) {
      const Endpoints endpoints{10, 10 * mu * (1 + excess)};
      const Friction friction = Friction::from_coefficient(mu);
      const double smallest = ConstantSpeedCurve::smallest_p(endpoints, friction, 9.81);
      for (const double factor : {1.001, 1.5, 10.0, 1e4, 1e8, 1e12}) {
        const double p = factor * smallest;
        const PlainCurve plain = plain_curve(endpoints, mu, 9.81, p);
        const ConstantSpeedCurve curve(endpoints, friction, 9.81, p);
        for (const double error :
             {relative_error(curve.entry_slope_angle().radians(), plain.entry_slope_angle),
              relative_error(curve.exit_slope_angle().radians(), plain.exit_slope_angle),
              relative_error(curve.length(), plain.length),
              relative_error(curve.speed(curve.length()), plain.exit_speed)}) {
          worst = std::max(worst, error);
          INFO("mu " << mu << ", excess " << excess << ", P / smallest P " << factor);
          CHECK(error < kConstantSpeedCurveAccuracy);
        }
      }
    }
  }
  CHECK(worst > 0.0);
  UNSCOPED_INFO("largest relative error " << worst);
  CHECK(worst < 0.1 * kConstantSpeedCurveAccuracy);
}

}  // namespace constant_speed_precision_test
