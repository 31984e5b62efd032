#include "glissade/motion/stall_friction.hpp"

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/straight_line.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "tracks.hpp"

#include <cmath>
#include <memory>
#include <numbers>

namespace stall_friction_test {

using namespace glissade;
using testing::track;

namespace {

Body body(double mu, double entry_speed) {
  return {.friction = Friction::from_coefficient(mu), .entry_speed = entry_speed};
}

double stall_angle(const CenterlinePtr& centerline, const Body& body) {
  const auto angle = stall_friction_angle(centerline, body);
  REQUIRE(angle);
  return angle->radians();
}

}  // namespace

TEST_CASE("stall friction: a straight ramp holds a body from rest at its own slope angle") {
  for (const double slope : {0.05, 0.6, 1.4}) {
    const auto ramp = track(slope, {{7.0, 0.0, 0.0}});
    for (const double mu : {0.0, 0.01, 5.0}) {
      CHECK(stall_angle(ramp, body(mu, 0.0)) == Approx(slope).margin(kStallFrictionAccuracy));
    }
  }
}

TEST_CASE("stall friction: with an entry speed the energy balance of a level says") {
  // u^2 / 2 = mu g S
  const double length = 4.0;
  const double speed = 3.0;
  const double mu = speed * speed / (2.0 * kDefaultGravity * length);
  const auto level = track(0.0, {{length, 0.0, 0.0}});
  CHECK(stall_angle(level, body(0.1, speed)) == Approx(std::atan(mu)).margin(kStallFrictionAccuracy));
}

TEST_CASE("stall friction: no track between two points can do better than the reach theorem") {
  const Endpoints endpoints{10.0, 5.0};
  const Friction friction = Friction::from_coefficient(0.2);
  const auto fastest = std::make_shared<CoulombBrachistochrone>(endpoints, friction, kDefaultGravity);
  const double bound = std::atan2(endpoints.drop, endpoints.run);
  const double angle = stall_angle(fastest, {.friction = friction});
  CHECK(angle > friction.angle().radians());
  CHECK(angle < bound);
  CHECK(stall_angle(std::make_shared<StraightLine>(endpoints), {.friction = friction}) ==
        Approx(bound).margin(kStallFrictionAccuracy));
}

TEST_CASE("stall friction: an uphill that no speed carries over gives 0, a fall gives none") {
  CHECK(stall_angle(track(-0.5, {{10.0, 0.0, 0.0}}), body(0.3, 1.0)) == 0.0);
  CHECK_FALSE(stall_friction_angle(track(std::numbers::pi / 2.0, {{10.0, 0.0, 0.0}}), body(0.3, 0.0)));
}

TEST_CASE("stall friction: changes along the track shift with it") {
  // A level of two halves: u^2 / 2 = g S (mu1 + mu2) / 2.
  Body two = body(0.1, 3.0);
  two.friction_changes = {{2.0, Friction::from_coefficient(0.05)}};
  const auto level = track(0.0, {{4.0, 0.0, 0.0}});
  const double first = stall_angle(level, two);
  const double shift = first - std::atan(0.1);
  const double mean = 0.5 * (std::tan(first) + std::tan(std::atan(0.05) + shift));
  CHECK(mean == Approx(9.0 / (2.0 * kDefaultGravity * 4.0)).margin(2.0 * kStallFrictionAccuracy));
}

TEST_CASE("stall friction: just below it no body stalls, just above it every one does") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 60; ++i) {
    const double slope = random.between(0.1, 1.3);
    const double bend = random.between(-0.05, 0.2);
    const auto ridden =
        track(slope, {{random.between(1.0, 6.0), 0.0, bend}, {random.between(0.5, 4.0), bend, bend}});
    const Body rider =
        body(random.between(0.0, 0.5), random.between(0.0, 1.0) < 0.5 ? 0.0 : random.between(0.0, 4.0));
    const auto angle = stall_friction_angle(ridden, rider);
    if (!angle || angle->radians() == 0.0) continue;
    const auto stalls = [&](double radians) {
      Body other = rider;
      other.friction = Friction::from_angle(Angle::from_radians(std::max(0.0, radians)));
      return Motion(ridden, other).stall().has_value();
    };
    CAPTURE(i, slope, bend, angle->degrees());
    CHECK_FALSE(stalls(angle->radians() - kStallFrictionAccuracy));
    CHECK(stalls(angle->radians() + 2.0 * kStallFrictionAccuracy));
    CHECK_FALSE(stalls(0.5 * angle->radians()));
    for (const double factor : {0.5, 0.99, 1.01}) {
      const Angle other = Angle::from_radians(factor * angle->radians());
      CHECK(stalls_at(ridden, rider, other) == stalls(other.radians()));
    }
  }
}

}  // namespace stall_friction_test
