#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/pudasaini.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <memory>

using namespace glissade;

namespace {

Motion ride(const ConstantSpeedCurve& curve, double entry_speed) {
  return {std::make_shared<const ConstantSpeedCurve>(curve),
          Body{.friction = curve.friction(), .entry_speed = entry_speed}, curve.gravity()};
}

}  // namespace

TEST_CASE(
    "constant-speed curve: the referee confirms travel time and speed, from rest and with an entry speed") {
  for (const ConstantSpeedCurve& curve : pudasaini::figure_one()) {
    for (const double entry_speed : {0.0, 0.01, 3.0, 25.0}) {
      const Motion motion = ride(curve, entry_speed);
      REQUIRE(motion.arrived());
      CHECK(motion.travel_time() == Approx(curve.travel_time(entry_speed)).epsilon(kMotionAccuracy));
      for (const double part : {0.05, 0.5, 1.0}) {
        const double s = part * curve.length();
        CHECK(motion.at(s).speed == Approx(curve.speed(s, entry_speed)).epsilon(kMotionAccuracy));
      }
    }
  }
}

TEST_CASE(
    "constant-speed curve: the referee sees a body fed at sqrt(P) keep its speed, in a valley and on a "
    "crest") {
  const Friction friction = Friction::from_coefficient(0.4);
  for (const Endpoints endpoints : {Endpoints{10, 8}, Endpoints{10, 4}, Endpoints{10, 2}}) {
    const ConstantSpeedCurve curve(endpoints, friction, 9.81, 400);
    const Motion motion = ride(curve, 20.0);
    REQUIRE(motion.arrived());
    for (const double part : {0.1, 0.5, 1.0}) {
      CHECK(motion.at(part * motion.distance()).speed == Approx(20.0).epsilon(kMotionAccuracy));
    }
  }
}

TEST_CASE("constant-speed curve: where it says that a body leaves a crest, the referee sees it leave") {
  const ConstantSpeedCurve hump({10, 2}, Friction::from_coefficient(0.4), 9.81, 100);
  CHECK_FALSE(hump.holds_body());
  CHECK(ride(hump, 10.0).lift_off().has_value());
  CHECK(ride(hump, hump.lift_off_speed(0) * 1.001).lift_off().has_value());
}

TEST_CASE("constant-speed curve: where it says that a body stalls, the referee sees it stall") {
  const ConstantSpeedCurve crest({10, 2}, Friction::from_coefficient(0.4), 9.81, 400);
  const Motion motion = ride(crest, 3.0);
  REQUIRE(motion.stall().has_value());
  // v = 0 where e^(2 mu |theta|) = P/(P - v_0), docs/theory.md (C10)
  const double turned = std::log(400.0 / (400.0 - 9.0)) / 0.8;
  const Angle there = Angle::from_radians(crest.entry_slope_angle().radians() + turned);
  CHECK(motion.stall()->arc_length == Approx(crest.arc_length_at_slope(there)).epsilon(1e-8));
}
