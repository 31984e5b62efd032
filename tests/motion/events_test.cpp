#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "tracks.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <boost/math/special_functions/ellint_1.hpp>

namespace events_test {

using namespace glissade;
using testing::track;

namespace {

constexpr double kGravity = kDefaultGravity;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Body body(double mu, double entry_speed, double drag = 0.0) {
  return {Friction::from_coefficient(mu), entry_speed, drag};
}

Approx close_to(double value) {
  return Approx(value).epsilon(1e-12).margin(0.0);
}

}  // namespace

TEST_CASE("stall: uphill a body stops where its energy is used up, and that takes u0 / a") {
  for (const double entry_speed : {1e-100, 1e-6, 0.3, 12.0}) {
    const double mu = 0.2;
    const double slope = 0.3;
    const Motion motion(track(-slope, {{50.0, 0.0, 0.0}}), body(mu, entry_speed));
    const double deceleration = kGravity * (std::sin(slope) + mu * std::cos(slope));
    REQUIRE(motion.stall().has_value());
    CHECK_FALSE(motion.arrived());
    CHECK_FALSE(motion.lift_off().has_value());
    CHECK(motion.stall()->arc_length == close_to(entry_speed * entry_speed / (2.0 * deceleration)));
    CHECK(motion.stall()->missing_slope.radians() == close_to(slope + std::atan(mu)));
    CHECK(motion.travel_time() == close_to(entry_speed / deceleration));
    CHECK(motion.exit_speed() == 0.0);
    CHECK(motion.distance() == motion.stall()->arc_length);
    // Half the time is left at a quarter of the way before the stop.
    const MotionState near_stop = motion.at(0.75 * motion.distance());
    CHECK(near_stop.speed == close_to(0.5 * entry_speed));
    CHECK(near_stop.time == close_to(0.5 * motion.travel_time()));
  }
}

TEST_CASE("stall: on the far side of a valley, where the energy balance with friction says") {
  const double radius = 5.0;
  const double mu = 0.3;
  const double entry = 1.2;
  const Motion motion(track(entry, {{radius * 2.0 * entry, 1.0 / radius, 1.0 / radius}}), body(mu, 0.0));
  REQUIRE(motion.stall().has_value());
  const double zeta = motion.centerline().slope_angle(motion.stall()->arc_length);
  const auto particular = [&](double angle) {
    return 3.0 * mu * std::sin(angle) + (1.0 - 2.0 * mu * mu) * std::cos(angle);
  };
  // Roberts' formula, v = 0 at both ends
  CHECK(particular(zeta) * std::exp(-2.0 * mu * zeta) ==
        close_to(particular(entry) * std::exp(-2.0 * mu * entry)));
  CHECK(motion.stall()->missing_slope.radians() == Approx(std::atan(mu) - zeta).epsilon(1e-14));
}

TEST_CASE("stall: drag alone never stops a body, on the level it takes (e^(k s) - 1) / (k u0)") {
  const Motion motion(track(0.0, {{40.0, 0.0, 0.0}}), body(0.0, 3.0, 0.5));
  REQUIRE(motion.arrived());
  CHECK(motion.exit_speed() == close_to(3.0 * std::exp(-20.0)));
  CHECK(motion.travel_time() == close_to(std::expm1(20.0) / 1.5));
}

TEST_CASE("a body at rest on a slope not steeper than the friction angle never moves") {
  const double mu = 0.25;
  for (const double missing : {0.0, 1e-3, 0.2, 1.0}) {
    const Motion motion(track(std::atan(mu) - missing, {{1.0, 0.0, 0.0}, {3.0, -0.3, -0.3}}), body(mu, 0.0));
    REQUIRE(motion.stall().has_value());
    CHECK(motion.stall()->arc_length == 0.0);
    CHECK(motion.stall()->missing_slope.radians() == Approx(missing).margin(1e-15));
    CHECK(motion.travel_time() == kInfinity);
    CHECK(motion.distance() == 0.0);
    CHECK(motion.exit_speed() == 0.0);
    CHECK(motion.at(0.0).time == 0.0);
    CHECK(motion.highest_load().normal_load == Approx(kGravity * std::cos(std::atan(mu) - missing)));
    CHECK_THROWS_AS(motion.at(0.1), InputError);
  }
}

TEST_CASE("a slope a hair steeper than the friction angle starts a body") {
  const double mu = 0.25;
  const double hair = 1e-9;
  const Motion motion(track(std::atan(mu) + hair, {{4.0, 0.0, 0.0}}), body(mu, 0.0));
  REQUIRE(motion.arrived());
  const double acceleration = kGravity * hair * std::sqrt(1.0 + mu * mu);
  CHECK(motion.travel_time() == Approx(std::sqrt(8.0 / acceleration)).epsilon(1e-6));
}

TEST_CASE("a body that has just the energy for the top of a crest takes endless time to get there") {
  const double radius = 2.0;
  const double theta = 0.5;
  const double entry_speed = 2.0 * std::sqrt(kGravity * radius) * std::sin(0.5 * theta);
  const Motion motion(track(-theta, {{theta * radius, -1.0 / radius, -1.0 / radius}}),
                      body(0.0, entry_speed));
  CHECK_FALSE(motion.arrived());
  REQUIRE(motion.stall().has_value());
  CHECK(motion.stall()->arc_length == theta * radius);
  CHECK(motion.stall()->missing_slope.radians() == 0.0);
  CHECK(motion.travel_time() == kInfinity);
  CHECK(motion.at(theta * radius).time == kInfinity);
  // u = 2 sqrt(g R) sin(zeta/2): T = sqrt(R/g) ln(tan(theta/4) / tan(zeta/4))
  const MotionState half_way = motion.at(0.5 * theta * radius);
  const double time =
      std::sqrt(radius / kGravity) * std::log(std::tan(0.25 * theta) / std::tan(0.125 * theta));
  CHECK(half_way.time == Approx(time).epsilon(1e-10));
}

TEST_CASE("lift-off: down the outside of a circle without friction at cos(zeta) = (2 + u0^2/(g R))/3") {
  const double radius = 4.0;
  for (const double entry_speed : {0.01, 1.0, 5.0}) {
    const Motion motion(track(0.0, {{radius * 1.5, -1.0 / radius, -1.0 / radius}}), body(0.0, entry_speed));
    REQUIRE(motion.lift_off().has_value());
    CHECK_FALSE(motion.arrived());
    CHECK_FALSE(motion.stall().has_value());
    const double cosine = (2.0 + entry_speed * entry_speed / (kGravity * radius)) / 3.0;
    CHECK(motion.lift_off()->arc_length == close_to(radius * std::acos(cosine)));
    CHECK(motion.lift_off()->speed == close_to(std::sqrt(kGravity * radius * cosine)));
    CHECK(motion.lift_off()->curvature == -1.0 / radius);
    CHECK(motion.distance() == motion.lift_off()->arc_length);
    CHECK(motion.exit_speed() == motion.lift_off()->speed);
    CHECK(std::fabs(motion.at(motion.distance()).normal_load) <= 1e-11 * kGravity);
    CHECK_THROWS_WITH(motion.at(radius * 1.5), Catch::Matchers::Contains("not on the ride"));
  }
}

namespace {

/// Squared speed and loss by friction at the end of a track of one rate of curvature each, by small steps of the classical
/// Runge-Kutta method with c |N|.
std::pair<double, double> held_ride(double zeta, const std::vector<ClothoidSegment>& segments,
                                    const Body& body) {
  double v = body.entry_speed * body.entry_speed;
  double loss = 0.0;
  for (const ClothoidSegment& segment : segments) {
    constexpr int kSteps = 20000;
    const double ds = segment.length / kSteps;
    const auto curvature = [&](double s) {
      return segment.entry_curvature +
             (segment.exit_curvature - segment.entry_curvature) * s / segment.length;
    };
    const auto slope = [&](double s) { return zeta - 0.5 * s * (segment.entry_curvature + curvature(s)); };
    const auto rubbed = [&](double s, double squared) {
      return body.friction.coefficient() * std::fabs(kGravity * std::cos(slope(s)) + curvature(s) * squared);
    };
    const auto rate = [&](double s, double squared) {
      return 2.0 * (kGravity * std::sin(slope(s)) - rubbed(s, squared) - body.drag_per_metre * squared);
    };
    for (int i = 0; i < kSteps; ++i) {
      const double s = ds * i;
      const double k1 = rate(s, v);
      const double k2 = rate(s + 0.5 * ds, v + 0.5 * ds * k1);
      const double k3 = rate(s + 0.5 * ds, v + 0.5 * ds * k2);
      const double k4 = rate(s + ds, v + ds * k3);
      const double before = rubbed(s, v);
      const double middle = rubbed(s + 0.5 * ds, v + 0.5 * ds * k2);
      v += ds / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      loss += ds / 6.0 * (before + 4.0 * middle + rubbed(s + ds, v));
    }
    zeta = slope(segment.length);
  }
  return {v, loss};
}

}  // namespace

TEST_CASE(
    "held from both sides: a body that would leave the track rides on, and rubs by the size of its load") {
  const std::vector<ClothoidSegment> segments = {
      {4.0, 0.0, 0.0}, {1.0, -0.6, -0.6}, {2.0, -0.6, 0.9}, {1.0, -0.3, -0.3}, {3.0, 0.2, 0.2}};
  const double entry = 0.4;
  for (const double drag : {0.0, 0.02}) {
    CAPTURE(drag);
    Body rider = body(0.15, 3.0, drag);
    const auto way = track(entry, segments);
    REQUIRE(Motion(way, rider).lift_off());
    rider.held = true;
    const Motion motion(way, rider);
    REQUIRE(motion.arrived());
    CHECK(motion.lowest_load().normal_load < -1.0);
    const auto [v, loss] = held_ride(entry, segments, rider);
    CHECK(motion.exit_speed() * motion.exit_speed() == Approx(v).epsilon(1e-8));
    const MotionState end = motion.at(motion.distance());
    CHECK(end.friction_loss == Approx(loss).epsilon(1e-7));
    const double energy = 0.5 * v + end.friction_loss + end.drag_loss;
    CHECK(energy == Approx(kGravity * way->endpoints().drop + 0.5 * 9.0).epsilon(1e-8));
    // In between as at the end: a ride to there is that ride.
    const MotionState middle = motion.at(4.5);
    CHECK(middle.normal_load < 0.0);
    CHECK(middle.friction_loss > motion.at(4.0).friction_loss);
  }
}

TEST_CASE("held from both sides: where the load stays positive nothing changes, and a body may still stall") {
  const auto valley = track(1.0, {{2.0, 0.0, 0.0}, {4.0, 0.45, 0.45}});
  Body rider = body(0.2, 0.0);
  const Motion free(valley, rider);
  rider.held = true;
  const Motion held(valley, rider);
  CHECK(held.distance() == free.distance());
  CHECK(held.travel_time() == free.travel_time());
  CHECK(held.exit_speed() == free.exit_speed());
  // Over a crest on which it presses upwards, and up a slope.
  const auto hill = track(0.9, {{3.0, 0.0, 0.0}, {0.3, -1.5, -1.5}, {3.0, 0.8, 0.8}, {60.0, 0.0, 0.0}});
  const Motion stalls(hill, rider);
  CHECK(stalls.lowest_load().normal_load < 0.0);
  REQUIRE(stalls.stall());
  CHECK(stalls.exit_speed() == 0.0);
}

TEST_CASE("lift-off: in a loop that the body enters too slowly") {
  const double radius = 1.5;
  const auto loop =
      track(0.0, {{1.0, 0.0, 0.0}, {2.0 * std::numbers::pi * radius, 1.0 / radius, 1.0 / radius}});
  const Motion fast(loop, body(0.0, std::sqrt(5.0001 * kGravity * radius)));
  CHECK(fast.arrived());
  CHECK(fast.lowest_load().normal_load == Approx(0.0001 * kGravity).epsilon(1e-9));
  CHECK(fast.lowest_load().arc_length == Approx(1.0 + std::numbers::pi * radius).epsilon(1e-7));
  const double energy = 4.0;
  const Motion slow(loop, body(0.0, std::sqrt(energy * kGravity * radius)));
  REQUIRE(slow.lift_off().has_value());
  const double turned = std::acos((2.0 - energy) / 3.0);
  CHECK(slow.lift_off()->arc_length == close_to(1.0 + radius * turned));
}

TEST_CASE("lift-off: at a jump of curvature the body leaves right there") {
  const auto kicker = track(0.4, {{5.0, 0.0, 0.0}, {1.0, -3.0, -3.0}, {5.0, 0.0, 0.0}});
  const Motion motion(kicker, body(0.1, 6.0));
  REQUIRE(motion.lift_off().has_value());
  CHECK(motion.lift_off()->arc_length == 5.0);
  CHECK(motion.lift_off()->curvature == -3.0);
  CHECK(motion.lowest_load().normal_load == Approx(kGravity * std::cos(0.4)).epsilon(1e-14));
}

TEST_CASE("lift-off: at the start where the entry speed is too high for the crest there") {
  const Motion motion(track(0.2, {{5.0, -1.0, 0.0}}), body(0.1, 4.0));
  REQUIRE(motion.lift_off().has_value());
  CHECK(motion.lift_off()->arc_length == 0.0);
  CHECK(motion.lift_off()->speed == 4.0);
  CHECK(motion.distance() == 0.0);
  CHECK(motion.travel_time() == 0.0);
  CHECK(motion.exit_speed() == 4.0);
}

TEST_CASE("lift-off: from rest on an overhang the body falls off at once") {
  const Motion motion(track(1.7, {{5.0, 0.0, 0.0}}), body(0.1, 0.0));
  REQUIRE(motion.lift_off().has_value());
  CHECK(motion.lift_off()->arc_length == 0.0);
}

TEST_CASE("lift-off: a crest of a tenth of a millimetre on a track of a kilometre is not overlooked") {
  const double bump = 1e-4;
  const auto bumpy = track(
      0.3,
      {{637.0, 0.0, 0.0}, {bump, 0.0, 30.0}, {bump, 30.0, -30.0}, {bump, -30.0, 0.0}, {363.0, 0.0, 0.0}});
  const Motion motion(bumpy, body(0.05, 0.0));
  REQUIRE(motion.lift_off().has_value());
  CHECK(motion.lift_off()->arc_length > 637.0 + bump);
  CHECK(motion.lift_off()->arc_length < 637.0 + 2.0 * bump);
  // One rounding of the arc length moves the load by this much where curvature changes so fast.
  const double rounding = 1e-13 * (60.0 / bump) * std::pow(motion.exit_speed(), 2);
  CHECK(motion.at(motion.distance()).normal_load == Approx(0.0).margin(2.0 * rounding));
}

TEST_CASE("lift-off: a crest that leaves the least load on the body does not count") {
  // At the top of a cosine-like crest between clothoids: choose the speed that leaves a load of 1e-6 g.
  const double crest = -0.2;
  const auto hill = track(0.1, {{4.0, 0.0, crest}, {4.0, crest, 0.0}});
  double low = 0.1;
  double high = 20.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (Motion(hill, body(0.0, middle)).lift_off() ? high : low) = middle;
  }
  const Motion just_pressed(hill, body(0.0, low * (1.0 - 1e-7)));
  CHECK(just_pressed.arrived());
  CHECK(just_pressed.lowest_load().normal_load > 0.0);
  CHECK(just_pressed.lowest_load().normal_load < 1e-5 * kGravity);
  const Motion just_flying(hill, body(0.0, high * (1.0 + 1e-7)));
  REQUIRE(just_flying.lift_off().has_value());
  CHECK(std::fabs(just_flying.lift_off()->arc_length - just_pressed.lowest_load().arc_length) < 0.01);
}

TEST_CASE("free fall down a vertical track keeps contact with no load") {
  const Motion motion(std::make_shared<const StraightLine>(Endpoints{0.0, 20.0}), body(0.5, 0.0));
  CHECK(motion.arrived());
  CHECK(motion.exit_speed() == close_to(std::sqrt(2.0 * kGravity * 20.0)));
  CHECK(motion.highest_load().normal_load == Approx(0.0).margin(1e-13));
  CHECK(motion.highest_speed().speed == motion.exit_speed());
}

TEST_CASE("highest load and speed lie between stations and are met to the last digits") {
  const double radius = 3.0;
  const double entry = 1.1;
  const auto valley = track(entry, {{radius * (entry + 0.7), 1.0 / radius, 1.0 / radius}});
  const Motion motion(valley, body(0.0, 0.0));
  const double bottom = radius * entry;
  CHECK(motion.highest_load().normal_load == close_to(kGravity * (3.0 - 2.0 * std::cos(entry))));
  CHECK(motion.highest_load().arc_length == Approx(bottom).epsilon(1e-7));
  CHECK(motion.highest_speed().speed ==
        close_to(std::sqrt(2.0 * kGravity * radius * (1.0 - std::cos(entry)))));
  CHECK(motion.highest_speed().arc_length == Approx(bottom).epsilon(1e-7));
  CHECK(motion.lowest_load().arc_length == 0.0);
  CHECK(motion.lowest_load().normal_load == close_to(kGravity * std::cos(entry)));
}

TEST_CASE("highest load just before curvature drops counts, although at() tells the load after it") {
  const auto dip = track(0.8, {{4.0, 0.0, 0.3}, {2.0, 0.0, 0.0}});
  const Motion motion(dip, body(0.1, 2.0));
  const MotionState highest = motion.highest_load();
  const MotionState after = motion.at(4.0);
  CHECK(highest.arc_length == 4.0);
  CHECK(highest.normal_load == close_to(after.normal_load + 0.3 * after.speed * after.speed));
  CHECK(highest.time == close_to(after.time));
}

TEST_CASE("a drag that rules the ride altogether is named where its steps are too many") {
  const auto ramp = std::make_shared<const StraightLine>(Endpoints{10.0, 6.0});
  CHECK(Motion(ramp, body(0.2, 0.0, 10.0)).arrived());
  CHECK_THROWS_WITH(Motion(ramp, body(0.2, 0.0, 5000.0)),
                    Catch::Matchers::Contains("A drag of 5000 1/m takes a body's speed within 0.2 mm") &&
                        Catch::Matchers::Contains("Try: the unit of drag"));
}

TEST_CASE("Motion says which number of the body it cannot use") {
  const auto ramp = std::make_shared<const StraightLine>(Endpoints{1.0, 1.0});
  CHECK_THROWS_WITH(Motion(ramp, body(0.1, -1.0)), Catch::Matchers::Contains("entry_speed: -1 m/s"));
  CHECK_THROWS_WITH(Motion(ramp, body(0.1, kInfinity)), Catch::Matchers::Contains("entry_speed: inf m/s"));
  CHECK_THROWS_WITH(Motion(ramp, body(0.1, 0.0, -0.5)),
                    Catch::Matchers::Contains("drag_per_metre: -0.5 1/m"));
  CHECK_THROWS_WITH(Motion(ramp, body(0.1, 0.0), 0.0), Catch::Matchers::Contains("gravity: 0 m/s^2"));
  CHECK_THROWS_WITH(Motion(ramp, body(0.1, 0.0), std::nan("")), Catch::Matchers::Contains("gravity: nan"));
  CHECK_THROWS_AS(Motion(nullptr, body(0.1, 0.0)), InputError);
  Body patchy = body(0.1, 0.0);
  const Friction other = Friction::from_coefficient(0.2);
  for (const double second : {0.5, 0.4, std::nan("")}) {
    patchy.friction_changes = {{0.5, other}, {second, patchy.friction}};
    CHECK_THROWS_WITH(Motion(ramp, patchy), Catch::Matchers::Contains("friction_changes: "));
  }
  patchy.friction_changes = {{0.0, other}, {0.0, patchy.friction}};
  CHECK_THROWS_WITH(Motion(ramp, patchy), Catch::Matchers::Contains("friction_changes: 0 m after 0 m"));
  patchy.friction_changes = {{0.0, other}, {0.5, patchy.friction}};
  CHECK_NOTHROW(Motion(ramp, patchy));
}

TEST_CASE("Motion rides whatever its bounds allow, and says which number leaves the range of numbers") {
  using Catch::Matchers::Contains;
  const auto ramp = std::make_shared<const StraightLine>(Endpoints{3.0, 4.0});
  CHECK_THROWS_WITH(Motion(ramp, body(0.2, 1e200)),
                    Contains("entry_speed: 1e+200 m/s is out of range") && Contains("Up to 1e+100 m/s"));
  CHECK_THROWS_WITH(Motion(ramp, body(0.2, 0.0), 1e308), Contains("gravity: 1e+308 m/s^2 is out of range"));
  CHECK_THROWS_WITH(Motion(ramp, body(0.2, 0.0), 1e-101), Contains("Between 1e-100 and 1e+100 m/s^2"));
  CHECK_THROWS_WITH(Motion(std::make_shared<const StraightLine>(Endpoints{0.0, 1e307}), body(0.2, 0.0)),
                    Contains("the track is 1e+307 m long, at a gravity of 9.81 m/s^2"));
  // From rest, and at no gravity worth the name, the laws of a straight ramp.
  for (const double gravity : {kWeakestGravity, 1.0, kStrongestGravity}) {
    for (const double size : {kShortestWay, 1.0, kLongestWay}) {
      CAPTURE(gravity, size);
      const auto line = std::make_shared<const StraightLine>(Endpoints{0.6 * size, 0.8 * size});
      const Motion ride(line, body(0.2, 0.0), gravity);
      const double pull = gravity * (0.8 - 0.2 * 0.6);
      CHECK(ride.exit_speed() == Approx(std::sqrt(2.0 * pull) * std::sqrt(size)).epsilon(1e-12));
      CHECK(ride.travel_time() == Approx(std::sqrt(2.0 / pull) * std::sqrt(size)).epsilon(1e-12));
    }
  }
  const Motion fast(ramp, body(0.2, kFastestEntry));
  CHECK(fast.exit_speed() == Approx(kFastestEntry).epsilon(1e-12));
}

TEST_CASE("what is looked for along a ride is a function: none is refused") {
  const Motion ride(std::make_shared<StraightLine>(Endpoints{3.0, 2.0}), Body{});
  CHECK_THROWS_WITH(ride.highest(Motion::Quantity()), Catch::Matchers::Contains("quantity: there is none"));
  CHECK_THROWS_WITH(ride.mean(Motion::Quantity()), Catch::Matchers::Contains("quantity: there is none"));
}

}  // namespace events_test
