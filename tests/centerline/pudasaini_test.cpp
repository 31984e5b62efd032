#include "glissade/centerline/pudasaini.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace glissade;

namespace {

constexpr int kStations = 20;

std::vector<CenterlinePoint> stations(const Centerline& track) {
  std::vector<CenterlinePoint> points;
  for (int station = 0; station <= kStations; ++station)
    points.push_back(track.at(track.length() * (static_cast<double>(station) / kStations)));
  return points;
}

pudasaini::Setting setting_of(const ConstantSpeedCurve& curve) {
  return {curve.friction(), curve.gravity(), curve.p()};
}

}  // namespace

TEST_CASE(
    "figure 1: seven curves, steeper start and deeper sag the lower the friction, none crosses another") {
  const std::vector<ConstantSpeedCurve> curves = pudasaini::figure_one();
  REQUIRE(curves.size() == 7);
  for (std::size_t next = 1; next < curves.size(); ++next) {
    const ConstantSpeedCurve& smooth = curves[next - 1];
    const ConstantSpeedCurve& rough = curves[next];
    CHECK(smooth.p() == 100.0);
    CHECK(smooth.entry_slope_angle() > rough.entry_slope_angle());
    CHECK(smooth.exit_slope_angle() < rough.exit_slope_angle());
    CHECK(pudasaini::sag(smooth) > pudasaini::sag(rough));
    for (int station = 1; station < kStations; ++station) {
      const double x = 2.5 * station / kStations;
      CHECK(smooth.at(smooth.arc_length_at_run(x)).drop > rough.at(rough.arc_length_at_run(x)).drop);
    }
  }
}

TEST_CASE("straight limit: the sag goes to zero as mu nears the mean slope, and like 1/P as P grows") {
  const auto sag = [](double mu, double p) {
    return pudasaini::sag(ConstantSpeedCurve({2.5, 2.5}, Friction::from_coefficient(mu), 9.81, p));
  };
  CHECK(sag(0.99, 100) < 0.02 * sag(0.2, 100));
  CHECK(sag(0.9999, 100) < 2e-4 * sag(0.2, 100));
  CHECK(sag(1.0, 100) == 0.0);
  CHECK(sag(0.2, 1e7) / sag(0.2, 1e6) == Approx(0.1).epsilon(1e-5));
  // docs/theory.md (P5): g l^2/(8 P) sin(mean slope angle - delta)/sin(delta), with a mean slope angle of 45
  // deg
  const double delta = std::atan(0.2);
  const double chord_squared = 2.5 * 2.5 * 2.0;
  CHECK(
      sag(0.2, 1e7) ==
      Approx(9.81 * chord_squared / 8e7 * std::sin(std::atan(1.0) - delta) / std::sin(delta)).epsilon(1e-5));
}

TEST_CASE(
    "eq. 15, 17, 18: the curve's slope angle, slope and curvature obey the first- and second-order forms") {
  for (const ConstantSpeedCurve& curve : pudasaini::figure_one()) {
    const pudasaini::Setting setting = setting_of(curve);
    const double c = pudasaini::offset(0, 0, curve.entry_slope_angle(), setting);
    CHECK(c == curve.entry_slope_angle().radians());
    for (const CenterlinePoint& point : stations(curve)) {
      CHECK(pudasaini::slope_angle_rate(Angle::from_radians(point.slope_angle), setting) ==
            Approx(-point.curvature).epsilon(1e-12));
      CHECK(pudasaini::offset(point.x, point.drop, Angle::from_radians(point.slope_angle), setting) ==
            Approx(c).epsilon(1e-13));
      const double slope = pudasaini::slope(point.x, point.drop, c, setting);
      CHECK(slope == Approx(std::tan(point.slope_angle)).epsilon(1e-12));
      // y'' = d(tan zeta)/dx = -kappa/cos^3(zeta)
      const double second = -point.curvature / std::pow(std::cos(point.slope_angle), 3);
      CHECK(pudasaini::slope_derivative(slope, setting) == Approx(second).epsilon(1e-11));
    }
  }
}

TEST_CASE("eq. 17 as printed, without its constant, does not describe a track that starts down a slope") {
  const ConstantSpeedCurve curve = pudasaini::figure_one().front();
  const CenterlinePoint point = curve.at(curve.length() / 2);
  CHECK(pudasaini::slope(point.x, point.drop, 0.0, setting_of(curve)) < 0.0);
  CHECK(std::tan(point.slope_angle) > 0.5);
}

TEST_CASE("eq. 19: K is one number along each track, and needs the absolute value on all of figure 1") {
  for (const ConstantSpeedCurve& curve : pudasaini::figure_one()) {
    const pudasaini::Setting setting = setting_of(curve);
    const double c = curve.entry_slope_angle().radians();
    const double mu = curve.friction().coefficient();
    const double k = pudasaini::implicit_constant(0, 0, c, setting);
    for (const CenterlinePoint& point : stations(curve)) {
      CHECK(pudasaini::implicit_constant(point.x, point.drop, c, setting) == Approx(k).margin(1e-13));
      CHECK(mu * std::cos(point.slope_angle) - std::sin(point.slope_angle) < 0.0);
    }
  }
}

TEST_CASE("eq. 19 holds as printed on a convex track, which is flatter than mu") {
  const ConstantSpeedCurve curve({2.5, 0.5}, Friction::from_coefficient(0.4), 9.81, 100);
  const double c = curve.entry_slope_angle().radians();
  const double k = pudasaini::implicit_constant(0, 0, c, setting_of(curve));
  for (const CenterlinePoint& point : stations(curve)) {
    CHECK(pudasaini::implicit_constant(point.x, point.drop, c, setting_of(curve)) == Approx(k).margin(1e-13));
    CHECK(0.4 * std::cos(point.slope_angle) - std::sin(point.slope_angle) > 0.0);
  }
}

TEST_CASE("eq. 7 and 9: the paper's speed and travel time from rest are those of the closed form") {
  for (const ConstantSpeedCurve& curve : pudasaini::figure_one()) {
    for (const CenterlinePoint& point : stations(curve)) {
      if (point.arc_length == 0.0) continue;
      const double speed =
          pudasaini::speed_from_rest(curve, point.arc_length, curve.friction(), curve.gravity());
      CHECK(speed == Approx(curve.speed(point.arc_length)).epsilon(1e-12));
      CHECK(speed < curve.constant_speed());
    }
    const double time = pudasaini::travel_time_from_rest(curve, curve.friction(), curve.gravity());
    CHECK(time == Approx(curve.travel_time()).epsilon(1e-10));
  }
}

TEST_CASE("scaled gravity and lambda are g/P and g/(P mu), and lambda refuses mu = 0") {
  const pudasaini::Setting setting{Friction::from_coefficient(0.25), 10.0, 100.0};
  CHECK(pudasaini::scaled_gravity(setting) == Approx(0.1).epsilon(1e-15));
  CHECK(pudasaini::lambda(setting) == Approx(0.4).epsilon(1e-15));
  CHECK_THROWS_WITH(pudasaini::lambda({Friction(), 10.0, 100.0}),
                    Catch::Matchers::Contains("lambda = g/(P mu) undefined"));
}
