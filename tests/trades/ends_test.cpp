// The ends of a chute: feeds that fall on it, and the belt that takes the stream away; each against closed forms and an
// integrator of its own.

#include "glissade/trades/chute/ends.hpp"

#include "glissade/centerline/straight_line.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <memory>
#include <numbers>

namespace ends_test {

using namespace glissade;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGravity = 9.81;

Friction friction_of(double angle_deg) {
  return Friction::from_angle(Angle::from_degrees(angle_deg));
}

}  // namespace

TEST_CASE("impact without bounce: cos(theta + phi)/cos(phi) of the speed is left") {
  struct Example {
    double theta, phi, ratio;
  };
  // Reference values of Stuart-Dick & Royal's formula.
  for (const Example& e : {Example{20.0, 25.0, 0.7802060087}, Example{45.0, 25.0, 0.3773774740},
                           Example{60.0, 30.0, 0.0}, Example{65.0, 25.0, 0.0}}) {
    const Landing landing{5.0, Angle::from_degrees(e.theta + 30.0)};
    const Impact impact = impact_on(landing, Angle::from_degrees(30.0), friction_of(e.phi), 1600.0);
    CHECK(impact.angle.radians() == Approx(e.theta * kDegree).epsilon(1e-12));
    CHECK(impact.speed_ratio == Approx(e.ratio).margin(1e-9));
    CHECK(impact.speed_ratio ==
          Approx(std::cos((e.theta + e.phi) * kDegree) / std::cos(e.phi * kDegree)).margin(1e-12));
    CHECK(impact.pressure == Approx(1600.0 * 25.0 * std::pow(std::sin(e.theta * kDegree), 2)).epsilon(1e-12));
  }
}

TEST_CASE("a slow stream stays on the pulley until gravity no longer holds it, a fast one leaves at once") {
  // v^2/(g R) = 0.5: leaves 60 deg past the top.
  const double speed = std::sqrt(0.5 * kGravity * 0.4);
  const FeedFall slow = fall_from_belt({speed, 0.4, Angle{}}, 1.0, kGravity);
  CHECK(slow.leaves_at.radians() == Approx(60.0 * kDegree).epsilon(1e-12));
  const FeedFall fast = fall_from_belt({3.2, 0.4, Angle::from_degrees(12.0)}, 1.0, kGravity);
  CHECK(fast.leaves_at.radians() == Approx(-12.0 * kDegree).epsilon(1e-12));
  // It leaves the pulley's top behind by the radius turned through.
  CHECK(slow.pulley.x == Approx(-slow.reach - 0.4 * std::sin(60.0 * kDegree)));
  CHECK(slow.pulley.y == Approx(1.0 - 0.4 * std::cos(60.0 * kDegree)));
}

TEST_CASE("a fall keeps its energy and its level speed, and is the parabola step by step") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 100; ++i) {
    const double speed = random.between(0.3, 6.0);
    const double drop = random.between(0.1, 4.0);
    const HeadPulley pulley{speed, random.between(0.1, 1.0),
                            Angle::from_degrees(random.between(-20.0, 20.0))};
    const FeedFall fall = fall_from_belt(pulley, drop, kGravity);
    CHECK(fall.landing.speed == Approx(std::sqrt(speed * speed + 2.0 * kGravity * drop)).epsilon(1e-12));
    CHECK(fall.landing.speed * std::cos(fall.landing.angle.radians()) ==
          Approx(speed * std::cos(fall.leaves_at.radians())).epsilon(1e-12));
    CHECK(fall.reach == Approx(speed * std::cos(fall.leaves_at.radians()) * fall.time).epsilon(1e-12));
    const double sunk =
        speed * std::sin(fall.leaves_at.radians()) * fall.time + 0.5 * kGravity * fall.time * fall.time;
    CHECK(sunk == Approx(drop).epsilon(1e-12));
  }
  const FeedFall straight = fall_from_outlet(0.5, 1.2, kGravity);
  CHECK(straight.landing.angle.radians() == Approx(0.5 * std::numbers::pi));
  CHECK(straight.reach == 0.0);
}

TEST_CASE("a stream that lands on its track rides on with what the impact leaves, at each friction its own") {
  StreamShape shape;
  shape.mass_flow = 100.0;
  shape.bulk_density = 1600.0;
  shape.width = 0.8;
  shape.wall_height = 0.5;
  Body body;
  body.law = std::make_shared<const BulkStream>(shape);
  body.landing = Landing{4.0, Angle::from_degrees(70.0)};
  const auto track = std::make_shared<const StraightLine>(Endpoints{3.0, 3.0 * std::tan(50.0 * kDegree)});
  double before = 10.0;
  for (const double angle : {20.0, 27.0, 35.0}) {
    body.friction = friction_of(angle);
    const Motion motion(track, body, kGravity);
    const double left = 4.0 * std::cos((20.0 + angle) * kDegree) / std::cos(angle * kDegree);
    CHECK(motion.body().entry_speed == Approx(left).epsilon(1e-12));
    CHECK(motion.at(0.0).speed == Approx(left).epsilon(1e-12));
    CHECK(left < before);
    before = left;
  }
  CHECK(enters(Motion(track, body, kGravity)));
  // What leaves a share of the speed, by the angle and by the friction that do.
  for (const double share : {0.3, 0.8}) {
    const Angle theta = steepest_impact(share, body.friction);
    CHECK(impact_on({4.0, theta}, Angle{}, body.friction, 1600.0).speed_ratio ==
          Approx(share).epsilon(1e-12));
    const Friction most = most_friction_of_impact(share, theta).value();
    CHECK(most.angle().radians() == Approx(body.friction.angle().radians()).epsilon(1e-9));
  }
  CHECK_FALSE(most_friction_of_impact(0.3, Angle::from_degrees(80.0)));
  // The flatter the impact, the more friction leaves the share; along the floor, every friction does.
  Friction least;
  for (double theta = 1.2; theta > 1e-20; theta *= 0.3) {
    const std::optional<Friction> most = most_friction_of_impact(0.3, Angle::from_radians(theta));
    REQUIRE(most);
    CHECK(*most >= least);
    CHECK_NOTHROW(Friction::from_angle(most->angle()));
    least = *most;
  }
  for (const double share : {0.3, 1.0}) {
    CHECK(most_friction_of_impact(share, Angle{}).value() >= least);
    CHECK(most_friction_of_impact(share, Angle{}).value().angle().degrees() > 89.999);
  }
  // theta + phi beyond 90 deg: it stands where it lands.
  body.landing = Landing{4.0, Angle::from_degrees(120.0)};
  body.friction = friction_of(30.0);
  const Motion stuck(track, body, kGravity);
  CHECK_FALSE(stuck.arrived());
  CHECK(stuck.distance() == 0.0);
  CHECK(lands(stuck));
  CHECK(stands_where_it_lands(stuck));
  CHECK_FALSE(enters(stuck));
  CHECK(to_text(ride_end(stuck)) == "stands where it lands");
  body.landing = Landing{4.0, Angle::from_degrees(40.0)};
  const Motion above(track, body, kGravity);
  CHECK_FALSE(enters(above));
  CHECK_FALSE(stands_where_it_lands(above));
  CHECK(to_text(ride_end(above)) == "flies over the start");
}

TEST_CASE("landing on a belt: Roberts' components and wear factor on a level belt without a drop") {
  const double slope = 40.0 * kDegree;
  const BeltLanding landing =
      land_on_belt(4.0, Angle::from_radians(slope), {3.5, Angle{}, Angle{}, 0.0, 0.5}, 1600.0, kGravity);
  const double from_vertical = 0.5 * std::numbers::pi - slope;
  CHECK(landing.speed_along == Approx(4.0 * std::sin(from_vertical)).epsilon(1e-12));
  CHECK(landing.speed_into == Approx(4.0 * std::cos(from_vertical)).epsilon(1e-12));
  CHECK(landing.speed_across == Approx(0.0).margin(1e-12));
  CHECK(landing.wear_factor ==
        Approx(std::pow(std::cos(from_vertical), 2) * (3.5 / 4.0 - std::sin(from_vertical))).epsilon(1e-12));
  CHECK(landing.wear == Approx(0.5 * 1600.0 * 64.0 * landing.wear_factor).epsilon(1e-12));
  CHECK(landing.match == Approx(landing.speed_along / 3.5));
  CHECK(landing.reach == 0.0);
  CHECK_FALSE(std::signbit(landing.speed_across));
  CHECK_FALSE(std::signbit(landing.off_centre));
}

TEST_CASE(
    "landing on a belt: faster or slower than the belt by as much, or beside it, the stream rubs as much") {
  const Angle slope = Angle::from_degrees(40.0);
  const auto on = [&](double speed, double direction) {
    return land_on_belt(4.0, slope, {speed, Angle::from_degrees(direction), Angle{}, 0.3, 0.5}, 1600.0,
                        kGravity);
  };
  const double ahead = on(3.0, 0.0).speed_along;
  CHECK(on(ahead - 0.7, 0.0).wear_factor == Approx(on(ahead + 0.7, 0.0).wear_factor).epsilon(1e-12));
  CHECK(on(ahead - 0.7, 0.0).wear_factor > 0.0);
  CHECK(on(ahead, 0.0).wear == Approx(0.0).margin(1e-9));
  // Square to the belt: its whole speed and that of the stream, at right angles.
  const BeltLanding across = on(2.0, 90.0);
  CHECK(across.wear ==
        Approx(0.5 * 1600.0 * across.speed_into * across.speed_into * std::hypot(2.0, ahead)).epsilon(1e-12));
}

TEST_CASE("landing on a belt: its own components are a turn of the stream's, whatever way it runs") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 100; ++i) {
    const double speed = random.between(1.0, 8.0);
    const double slope = random.between(-0.2, 1.3);
    const ReceivingBelt belt{random.between(1.0, 5.0), Angle::from_degrees(random.between(-90.0, 90.0)),
                             Angle::from_degrees(random.between(-15.0, 15.0)), random.between(0.0, 2.0), 0.5};
    const BeltLanding landing = land_on_belt(speed, Angle::from_radians(slope), belt, 1600.0, kGravity);
    CHECK(std::pow(landing.speed_along, 2) + std::pow(landing.speed_into, 2) +
              std::pow(landing.speed_across, 2) ==
          Approx(landing.speed * landing.speed).epsilon(1e-12));
    CHECK(landing.speed == Approx(std::sqrt(speed * speed + 2.0 * kGravity * belt.drop)).epsilon(1e-12));
    const double sunk = speed * std::sin(slope) * landing.time + 0.5 * kGravity * landing.time * landing.time;
    CHECK(sunk == Approx(belt.drop).margin(1e-12));
  }
  // Across the belt: nothing along it, and it lands beside the middle.
  const BeltLanding across = land_on_belt(
      4.0, Angle::from_radians(0.5), {2.0, Angle::from_degrees(90.0), Angle{}, 0.5, 0.5}, 1600.0, kGravity);
  CHECK(across.speed_along == Approx(0.0).margin(1e-12));
  CHECK(across.off_centre == Approx(-across.reach));
}

TEST_CASE("landing on a belt: what comes to its plane from below does not land") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int landed = 0;
  int missed = 0;
  for (int i = 0; i < 300; ++i) {
    const double speed = random.between(1.0, 8.0);
    const double slope = random.between(-0.3, 0.6);
    const double climb = random.between(-0.8, 0.4);
    const ReceivingBelt belt{3.0, Angle::from_degrees(random.between(-60.0, 60.0)),
                             Angle::from_radians(climb), random.between(0.01, 0.2), 0.5};
    const BeltLanding landing = land_on_belt(speed, Angle::from_radians(slope), belt, 1600.0, kGravity);
    // How high above its plane a stream is a little before it comes there, square to it.
    const double before = 1e-6 * landing.time;
    const double time = landing.time - before;
    const double back = speed * std::cos(slope) * before * std::cos(belt.direction.radians());
    const double height = belt.drop - speed * std::sin(slope) * time - 0.5 * kGravity * time * time;
    CHECK(landing.lands() == (height * std::cos(climb) + back * std::sin(climb) > 0.0));
    ++(landing.lands() ? landed : missed);
  }
  CHECK(landed > 20);
  CHECK(missed > 20);
  // Laid down along it, whatever its slope: no speed into it, and none away from it.
  for (int degrees = 1; degrees < 60; ++degrees) {
    CHECK(land_on_belt(4.0, Angle::from_degrees(degrees),
                       {4.0, Angle{}, Angle::from_degrees(-degrees), 0.0, 0.5}, 1600.0, kGravity)
              .lands());
  }
}

}  // namespace ends_test
