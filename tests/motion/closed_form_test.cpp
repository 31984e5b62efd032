#include "glissade/centerline/straight_line.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "tracks.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_1.hpp>

namespace closed_form_test {

using namespace glissade;
using testing::track;

namespace {

constexpr double kGravity = kDefaultGravity;
/// What the closed forms of docs/theory.md are met to.
constexpr double kClosedFormAccuracy = 1e-12;

Approx close_to(double value) {
  return Approx(value).epsilon(kClosedFormAccuracy).margin(0.0);
}

}  // namespace

TEST_CASE("straight ramp from rest: T = sqrt(2 l / (g (sin - mu cos))), from any slope and length") {
  for (const double length : {1e-3, 1.0, 1e5}) {
    for (const double slope : {0.25, 0.7, 1.2, std::numbers::pi / 2.0}) {
      for (const double mu : {0.0, 0.1, 0.25}) {
        const auto ramp = std::make_shared<const StraightLine>(
            Endpoints{length * std::cos(slope), length * std::sin(slope)});
        const Motion motion(ramp, {Friction::from_coefficient(mu), 0.0, 0.0});
        const double zeta = ramp->slope_angle(0.0);
        const double acceleration = kGravity * (std::sin(zeta) - mu * std::cos(zeta));
        REQUIRE(motion.arrived());
        CHECK(motion.distance() == ramp->length());
        CHECK(motion.travel_time() == close_to(std::sqrt(2.0 * ramp->length() / acceleration)));
        CHECK(motion.exit_speed() == close_to(std::sqrt(2.0 * ramp->length() * acceleration)));
        const MotionState quarter = motion.at(0.25 * ramp->length());
        CHECK(quarter.time == close_to(0.5 * motion.travel_time()));
        CHECK(quarter.speed == close_to(0.5 * motion.exit_speed()));
      }
    }
  }
}

TEST_CASE("straight ramp: time and speed hold for every entry speed, however small") {
  const auto ramp = std::make_shared<const StraightLine>(Endpoints{8.0, 6.0});
  const double mu = 0.3;
  const double acceleration = kGravity * (0.6 - mu * 0.8);
  for (double entry_speed = 1e-150; entry_speed < 1e4; entry_speed *= 37.0) {
    const Motion motion(ramp, {Friction::from_coefficient(mu), entry_speed, 0.0});
    for (const double s : {1e-9, 1e-3, 1.0, 10.0}) {
      const double speed = std::sqrt(entry_speed * entry_speed + 2.0 * acceleration * s);
      const MotionState state = motion.at(s);
      CHECK(state.speed == close_to(speed));
      CHECK(state.time == close_to(2.0 * s / (entry_speed + speed)));
    }
  }
}

TEST_CASE("drag on a straight: v = v_inf^2 + (v0^2 - v_inf^2) e^(-2 k s), and the time that belongs to it") {
  const double length = 60.0;
  const double zeta = 0.9;
  const double mu = 0.2;
  const double push = kGravity * (std::sin(zeta) - mu * std::cos(zeta));
  for (const double drag : {1e-6, 0.003, 0.05, 2.0}) {
    const double terminal = std::sqrt(push / drag);
    for (const double entry_speed : {0.0, 1e-3, 5.0, 3.0 * terminal}) {
      const Motion motion(track(zeta, {{length, 0.0, 0.0}}),
                          {Friction::from_coefficient(mu), entry_speed, drag});
      const double v_inf = terminal * terminal;
      const double v0 = entry_speed * entry_speed;
      for (const double s : {0.01, 3.0, length}) {
        // v = v0 e + v_inf (1 - e), written without a difference of near equals
        const double v = v0 * std::exp(-2.0 * drag * s) - v_inf * std::expm1(-2.0 * drag * s);
        CHECK(motion.at(s).speed == close_to(std::sqrt(v)));
      }
      // u = u_inf tanh(u_inf k t) from rest: k s = ln cosh(u_inf k t)
      if (entry_speed != 0.0) continue;
      const double growth = std::expm1(drag * length);
      const double time = std::log1p(growth + std::sqrt(growth * (growth + 2.0))) / (terminal * drag);
      CHECK(motion.travel_time() == close_to(time));
    }
  }
}

TEST_CASE("circular arc: Roberts' chute formula, at every station") {
  const double radius = 7.0;
  const double entry = 1.3;
  const double mu = 0.35;
  const double entry_speed = 4.0;
  const auto arc = track(entry, {{radius * 1.1, 1.0 / radius, 1.0 / radius}});
  const Motion motion(arc, {Friction::from_coefficient(mu), entry_speed, 0.0});
  const auto particular = [&](double zeta) {
    return 2.0 * kGravity * radius * (3.0 * mu * std::sin(zeta) + (1.0 - 2.0 * mu * mu) * std::cos(zeta)) /
           (1.0 + 4.0 * mu * mu);
  };
  const double constant = (entry_speed * entry_speed - particular(entry)) * std::exp(-2.0 * mu * entry);
  REQUIRE(motion.arrived());
  for (int i = 0; i <= 50; ++i) {
    const double s = arc->length() * i / 50.0;
    const double zeta = arc->slope_angle(s);
    const double v = constant * std::exp(2.0 * mu * zeta) + particular(zeta);
    CHECK(motion.at(s).speed == close_to(std::sqrt(v)));
    CHECK(motion.at(s).normal_load == close_to(kGravity * std::cos(zeta) + v / radius));
  }
}

TEST_CASE("frictionless arc from rest: a quarter of a pendulum's swing, an elliptic integral") {
  const double radius = 3.0;
  for (const double angle : {0.01, 0.5, 1.5}) {
    const Motion motion(track(angle, {{radius * angle, 1.0 / radius, 1.0 / radius}}), {Friction{}, 0.0, 0.0});
    const double quarter = std::sqrt(radius / kGravity) * boost::math::ellint_1(std::sin(0.5 * angle));
    CHECK(motion.travel_time() == close_to(quarter));
  }
}

TEST_CASE("a swing that ends at rest exactly at the finish arrives there, at no speed") {
  const double radius = 3.0;
  const double angle = 1.0;
  const Motion motion(track(angle, {{radius * 2.0 * angle, 1.0 / radius, 1.0 / radius}}),
                      {Friction{}, 0.0, 0.0});
  const double half = 2.0 * std::sqrt(radius / kGravity) * boost::math::ellint_1(std::sin(0.5 * angle));
  REQUIRE(motion.arrived());
  CHECK(motion.distance() == motion.centerline().length());
  CHECK(motion.exit_speed() == 0.0);
  CHECK(motion.travel_time() == close_to(half));
}

TEST_CASE("near the top of a crest that it only just passes, a body's time is still exact") {
  // Over a frictionless arc of +-theta, v = v_top + 4 g R sin^2(zeta/2); with sin(zeta/2) = sqrt(v_top/(4gR))
  // sinh(tau) the time is the integral of a smooth function of tau.
  const double radius = 2.0;
  const double theta = 0.5;
  const double to_top = 4.0 * kGravity * radius * std::pow(std::sin(0.5 * theta), 2);
  for (const double margin : {1.0, 1e-2, 1e-4, 1e-6}) {
    const double entry_speed = std::sqrt(to_top * (1.0 + margin));
    const long double v_top = static_cast<long double>(entry_speed) * entry_speed -
                              4.0L * kGravity * radius * std::pow(std::sin(0.5L * theta), 2);
    const auto ratio = static_cast<double>(v_top / (4.0L * kGravity * radius));
    const double tau = std::asinh(std::sin(0.5 * theta) / std::sqrt(ratio));
    const double integral = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        [&](double t) { return 1.0 / std::sqrt(1.0 - ratio * std::pow(std::sinh(t), 2)); }, 0.0, tau, 15,
        1e-14);
    const double time = 4.0 * radius / std::sqrt(4.0 * kGravity * radius) * integral;

    const Motion motion(track(-theta, {{2.0 * theta * radius, -1.0 / radius, -1.0 / radius}}),
                        {Friction{}, entry_speed, 0.0});
    REQUIRE(motion.arrived());
    // One rounding of the entry speed moves v at the top by 1 / margin roundings.
    CHECK(motion.travel_time() == Approx(time).epsilon(1e-13 + 1e-16 / margin).margin(0.0));
  }
}

TEST_CASE("cycloid from its cusp, where curvature is unbounded: T = sqrt(R/g) theta without friction") {
  for (const double radius : {1e-4, 1.0, 3e4}) {
    for (const double theta : {0.001, 1.0, 3.0}) {
      const Motion motion(std::make_shared<const testing::Cycloid>(radius, theta), {Friction{}, 0.0, 0.0});
      REQUIRE(motion.arrived());
      CHECK(motion.travel_time() == close_to(std::sqrt(radius / kGravity) * theta));
      CHECK(motion.exit_speed() == close_to(2.0 * std::sqrt(kGravity * radius) * std::sin(0.5 * theta)));
      CHECK(motion.at(0.0).normal_load == Approx(0.0).margin(1e-14));
    }
  }
}

TEST_CASE("cycloid with friction and an entry speed: the closed speed law, and an endless load at the cusp") {
  // dv/dtheta + mu v = 4 g R sin(theta/2) (cos(theta/2) - mu sin(theta/2)) = 2 g R (sin - mu + mu cos)(theta)
  const double radius = 2.0;
  const double mu = 0.4;
  const double entry_speed = 0.7;
  const double theta_end = 2.0;
  const auto particular = [&](double theta) {
    const double sine = 2.0 * mu / (1.0 + mu * mu);
    const double cosine = (mu * mu - 1.0) / (1.0 + mu * mu);
    return 2.0 * kGravity * radius * (sine * std::sin(theta) + cosine * std::cos(theta) - 1.0);
  };
  const auto v = [&](double theta) {
    return (entry_speed * entry_speed - particular(0.0)) * std::exp(-mu * theta) + particular(theta);
  };
  const auto cycloid = std::make_shared<const testing::Cycloid>(radius, theta_end);
  const Motion motion(cycloid, {Friction::from_coefficient(mu), entry_speed, 0.0});
  REQUIRE(motion.arrived());
  CHECK(motion.exit_speed() == close_to(std::sqrt(v(theta_end))));
  const double time = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
      [&](double theta) { return 2.0 * radius * std::sin(0.5 * theta) / std::sqrt(v(theta)); }, 0.0,
      theta_end, 15, 1e-14);
  CHECK(motion.travel_time() == close_to(time));
  CHECK(std::isinf(motion.highest_load().normal_load));
  CHECK(motion.highest_load().arc_length == 0.0);
  const MotionState finish = motion.at(motion.distance());
  const double drop = cycloid->endpoints().drop;
  CHECK(0.5 * v(theta_end) + finish.friction_loss ==
        close_to(kGravity * drop + 0.5 * entry_speed * entry_speed));
}

}  // namespace closed_form_test
