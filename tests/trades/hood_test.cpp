// A stream below a hood: the referee against Roberts' closed form of the inverted curve, against an integrator of its own,
// and what must hold however it is turned.

#include "glissade/trades/chute/hood.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/trades/chute/stream.hpp"
#include "glissade/trades/chute/wear.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <memory>
#include <numbers>

namespace hood_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGravity = 9.81;

/// 650 t/h of ore, 800 mm wide.
Body ore(double friction, double pressure_ratio = 0.5) {
  StreamShape shape;
  shape.mass_flow = 650.0 / 3.6;
  shape.bulk_density = 1600.0;
  shape.lateral_pressure_ratio = pressure_ratio;
  shape.width = WidthLaw(0.8);
  shape.wall_height = 0.5;
  Body body;
  body.friction = Friction::from_coefficient(friction);
  body.law = std::make_shared<const BulkStream>(shape);
  return body;
}

HoodShape hood_of(double radius, double impact_deg, double exit_deg, double drop = 0.5) {
  return {radius, Angle::from_degrees(impact_deg), Angle::from_degrees(exit_deg), drop};
}

/// Roberts' v^2 on an inverted arc with one equivalent friction, phi from the vertical:
/// [2 g R/(1 + 4 mu^2)] [(2 mu^2 - 1) sin(phi) + 3 mu cos(phi)] + C e^(2 mu phi).
double inverted_arc_v2(double v0, double radius, double mu, double phi0, double phi) {
  const auto particular = [&](double at) {
    return 2.0 * kGravity * radius / (1.0 + 4.0 * mu * mu) *
           ((2.0 * mu * mu - 1.0) * std::sin(at) + 3.0 * mu * std::cos(at));
  };
  return particular(phi) + (v0 * v0 - particular(phi0)) * std::exp(2.0 * mu * (phi - phi0));
}

struct Ridden {
  double v = 0.0;
  double time = 0.0;
};

/// dv/dzeta and dt/dzeta of a stream below an arc, by Runge and Kutta's steps of fourth order.
Ridden integrated(double speed, double radius, double from, double to, const Body& body) {
  const StreamShape& shape = stream_of(body)->shape();
  const double mu = body.friction.coefficient();
  const double width = shape.width.at(0.0);
  const auto slope = [&](double zeta, double v) {
    const double depth = shape.mass_flow / (shape.bulk_density * width * std::sqrt(v));
    const double rubs = mu * (1.0 + shape.lateral_pressure_ratio * depth / width);
    const double pressed = v / radius - kGravity * std::cos(zeta);
    return 2.0 * radius * (kGravity * std::sin(zeta) - rubs * pressed);
  };
  constexpr int kSteps = 20000;
  const double h = (to - from) / kSteps;
  Ridden at{speed * speed, 0.0};
  for (int i = 0; i < kSteps; ++i) {
    const double zeta = from + h * i;
    const double a = slope(zeta, at.v);
    const double b = slope(zeta + 0.5 * h, at.v + 0.5 * h * a);
    const double c = slope(zeta + 0.5 * h, at.v + 0.5 * h * b);
    const double d = slope(zeta + h, at.v + h * c);
    const double pace = 1.0 / std::sqrt(at.v);
    const double middle = 1.0 / std::sqrt(at.v + 0.5 * h * a + h * h * (b - a) / 4.0);
    at.v += h * (a + 2.0 * b + 2.0 * c + d) / 6.0;
    at.time += radius * h * (pace + 4.0 * middle + 1.0 / std::sqrt(at.v)) / 6.0;
  }
  return at;
}

}  // namespace

TEST_CASE("below a hood without walls: Roberts' closed form of the inverted curve") {
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 60; ++i) {
    const double mu = random.between(0.0, 0.7);
    const double radius = random.between(0.5, 4.0);
    const double entry = random.between(-10.0, 50.0) * kDegree;
    const double exit = random.between(entry / kDegree + 5.0, 90.0) * kDegree;
    // Fast enough that it is pressed on the hood all along.
    const double speed = random.between(1.2, 3.0) * std::sqrt(kGravity * radius);
    const Landing feed{speed, Angle::from_radians(entry)};
    const Body body = ore(mu, 0.0);
    const HoodPassage passage = pass_hood(hood_of(radius, 0.0, exit / kDegree), feed, body, kGravity);
    INFO("mu " << mu << ", radius " << radius << ", from " << entry / kDegree << " to " << exit / kDegree);
    if (!passage.holds()) continue;  // friction took its contact: the next test
    const double expected =
        inverted_arc_v2(speed, radius, mu, 0.5 * std::numbers::pi - entry, 0.5 * std::numbers::pi - exit);
    const double found = passage.motion.exit_speed();
    CHECK(found * found == Approx(expected).epsilon(1e-11));
    CHECK(passage.contact == Approx(speed * speed / (kGravity * radius * std::cos(entry))).epsilon(1e-12));
    // The load is what presses on the hood, and friction's work is that of the load.
    const MotionState at = passage.motion.at(0.5 * passage.motion.distance());
    const double zeta = passage.motion.centerline().slope_angle(at.arc_length);
    CHECK(at.normal_load == Approx(at.speed * at.speed / radius - kGravity * std::cos(zeta)).epsilon(1e-11));
    const double drop = passage.motion.centerline().endpoints().drop;
    const MotionState end = passage.motion.at(passage.motion.distance());
    CHECK(0.5 * end.speed * end.speed + end.friction_loss ==
          Approx(kGravity * drop + 0.5 * speed * speed).epsilon(1e-11));
  }
}

TEST_CASE("below a hood with walls: an integrator of its own, speed and time") {
  testing::Random random = testing::seeded_random();
  int held = 0;
  for (int i = 0; i < 20; ++i) {
    const Body body = ore(random.between(0.2, 0.6));
    const double radius = random.between(0.6, 2.0);
    const Landing feed{random.between(1.3, 2.0) * std::sqrt(kGravity * radius),
                       Angle::from_radians(random.between(0.0, 0.5))};
    const double impact = random.between(0.0, 20.0);
    const double exit = random.between(60.0, 90.0);
    const HoodPassage passage = pass_hood(hood_of(radius, impact, exit), feed, body, kGravity);
    if (!passage.holds()) continue;
    ++held;
    const double theta = impact * kDegree;
    const double enters = feed.speed * (std::cos(theta) - body.friction.coefficient() * std::sin(theta));
    CHECK(passage.impact.speed_ratio * feed.speed == Approx(enters).epsilon(1e-12));
    const Ridden expected = integrated(enters, radius, feed.angle.radians() + theta, exit * kDegree, body);
    CHECK(passage.motion.exit_speed() == Approx(std::sqrt(expected.v)).epsilon(1e-9));
    CHECK(passage.motion.travel_time() == Approx(expected.time).epsilon(1e-9));
  }
  CHECK(held > 5);
}

TEST_CASE("v^2/(g R) = 0.544 on a level hood is no contact: the stream falls away at once") {
  // Vector E of the chute facts: v0 = 4, R = 3, mu = 0.4, phi = 90 deg.
  const HoodPassage passage = pass_hood(hood_of(3.0, 0.0, 80.0), {4.0, Angle{}}, ore(0.4), kGravity);
  CHECK(passage.contact == Approx(0.544).epsilon(1e-3));
  CHECK_FALSE(passage.holds());
  REQUIRE(passage.motion.lift_off());
  CHECK(passage.motion.distance() == Approx(0.0).margin(1e-9));
  // What has no contact falls as if there were no hood.
  const double height = passage.start.y;
  CHECK(passage.landing.speed == Approx(std::sqrt(16.0 + 2.0 * kGravity * height)).epsilon(1e-9));
  CHECK(passage.reach == Approx(4.0 * std::sqrt(2.0 * height / kGravity)).epsilon(1e-9));
}

TEST_CASE("contact ends where v^2/(g R) falls to the cosine of the slope, wherever that is") {
  testing::Random random = testing::seeded_random();
  int lost = 0;
  for (int i = 0; i < 200; ++i) {
    const double radius = random.between(0.8, 3.0);
    // A rising stream: what is pressed on where it falls, is so from there on, as both gravity's share and the speed's grow.
    const Landing feed{random.between(0.8, 1.3) * std::sqrt(kGravity * radius),
                       Angle::from_radians(random.between(-0.7, 0.0))};
    const HoodPassage passage =
        pass_hood(hood_of(radius, 0.0, 85.0), feed, ore(random.between(0.3, 0.9)), kGravity);
    CHECK((passage.holds() ? passage.least_contact >= 1.0 - 1e-9 : passage.least_contact <= 1.0 + 1e-9));
    if (!passage.motion.lift_off() || passage.motion.distance() == 0.0) continue;
    ++lost;
    const double speed = passage.motion.exit_speed();
    const double zeta = passage.motion.centerline().slope_angle(passage.motion.distance());
    CHECK(speed * speed / (kGravity * radius) == Approx(std::cos(zeta)).epsilon(1e-9));
  }
  CHECK(lost > 0);
}

TEST_CASE("on a hood that falls from its entry on, contact there is contact all along") {
  // d/dzeta (v^2 - g R cos(zeta)) = 3 g R sin(zeta) > 0 where the load is 0: it cannot fall through 0.
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 200; ++i) {
    const double radius = random.between(0.5, 3.0);
    const Landing feed{random.between(0.7, 2.0) * std::sqrt(kGravity * radius),
                       Angle::from_radians(random.between(0.0, 0.6))};
    const HoodPassage passage = pass_hood(hood_of(radius, random.between(0.0, 20.0), 88.0), feed,
                                          ore(random.between(0.0, 0.9), 0.0), kGravity);
    if (passage.motion.law_end()) continue;  // it came to a stand
    CHECK(passage.holds() == (passage.contact >= 1.0));
  }
}

TEST_CASE("what leaves a hood keeps its level speed and its energy on its way down") {
  const Body body = ore(0.5);
  const HoodPassage passage =
      pass_hood(hood_of(1.0, 8.0, 75.0, 0.7), {4.5, Angle::from_radians(0.2)}, body, kGravity);
  REQUIRE(passage.holds());
  const double left = passage.motion.exit_speed();
  CHECK(passage.landing.speed == Approx(std::sqrt(left * left + 2.0 * kGravity * 0.7)).epsilon(1e-12));
  CHECK(passage.landing.speed * std::cos(passage.landing.angle.radians()) ==
        Approx(left * std::cos(75.0 * kDegree)).epsilon(1e-12));
  CHECK(passage.reach == Approx(left * std::cos(75.0 * kDegree) * passage.fall_time).epsilon(1e-12));
  // Down by the arc's own drop and that below its edge.
  const double entry = 0.2 + 8.0 * kDegree;
  CHECK(passage.start.x == Approx(std::sin(75.0 * kDegree) - std::sin(entry) + passage.reach).epsilon(1e-12));
  CHECK(passage.start.y == Approx(std::cos(entry) - std::cos(75.0 * kDegree) + 0.7).epsilon(1e-12));
}

TEST_CASE("the landing of a track below a hood is that of its friction") {
  const Landing feed{4.5, Angle::from_radians(0.2)};
  const HoodShape hood = hood_of(1.0, 8.0, 80.0, 0.6);
  Body body = ore(0.5);
  body.approach = std::make_shared<const HoodApproach>(hood, feed, kGravity);
  const auto track = std::make_shared<const StraightLine>(Endpoints{0.8, 1.0});
  double before = 1e9;
  for (const double mu : {0.3, 0.4, 0.5, 0.6}) {
    body.friction = Friction::from_coefficient(mu);
    const Motion motion(track, body, kGravity);
    const Landing expected = pass_hood(hood, feed, body, kGravity).landing;
    REQUIRE(motion.body().landing);
    CHECK(motion.body().landing->speed == expected.speed);
    CHECK(motion.body().entry_speed ==
          speed_after(expected, Angle::from_radians(track->slope_angle(0.0)), body.friction));
    CHECK(expected.speed < before);  // more friction, less speed
    before = expected.speed;
  }
}

TEST_CASE("a hood that does not turn its stream down is refused") {
  CHECK_THROWS_WITH(hood_arc(hood_of(1.0, 20.0, 60.0), {4.0, Angle::from_degrees(50.0)}),
                    Contains("exit_angle: 60 deg, the stream meets the hood at 70 deg"));
  CHECK_THROWS_WITH(hood_arc(hood_of(1.0, 20.0, 100.0), {4.0, Angle::from_degrees(50.0)}),
                    Contains("straight down"));
  CHECK_THROWS_WITH(hood_arc(hood_of(-1.0, 20.0, 80.0), {4.0, Angle{}}), Contains("radius"));
}

TEST_CASE("what only a stream has is not asked of a body that is none") {
  const auto track = std::make_shared<const StraightLine>(Endpoints{4.0, 3.0});
  Body point;
  point.friction = Friction::from_coefficient(0.3);
  point.entry_speed = 2.0;
  const Landing feed{3.5, Angle::from_degrees(20.0)};
  CHECK_THROWS_WITH(pass_hood(hood_of(1.0, 10.0, 80.0), feed, point, kGravity), Contains("no stream"));
  for (const double speed : {0.0, -1.0, std::nan("")}) {
    const Landing still{speed, feed.angle};
    Body stream = point;
    stream.law = std::make_shared<const BulkStream>(StreamShape{10.0, 1600.0, 0.5, 0.6});
    CHECK_THROWS_WITH(pass_hood(hood_of(1.0, 10.0, 80.0), still, stream, kGravity),
                      Contains("feed: ") && Contains(" m/s is not a finite speed above 0"));
    stream.landing = still;
    CHECK_THROWS_WITH(Motion(track, stream),
                      Contains("landing: ") && Contains(" m/s is not a finite speed above 0"));
  }
  CHECK_THROWS_WITH(HoodApproach(hood_of(1.0, 10.0, 80.0), feed, kGravity).landing(point),
                    Contains("no stream"));
  const Motion ride(track, point);
  CHECK_THROWS_WITH(wear_of({&ride}), Contains("ride 1 is of no stream"));
  CHECK_THROWS_WITH(floor_loads({&ride}), Contains("ride 1 is of no stream"));
  CHECK_THROWS_WITH(wear_of({nullptr}), Contains("ride 1 is none"));
  CHECK_THROWS_WITH(floor_loads({nullptr}), Contains("ride 1 is none"));
  CHECK_THROWS_AS(wear_of({}), InputError);
  CHECK_THROWS_WITH(choking_mass_flow(track, point, kGravity), Contains("no stream"));
  CHECK_THROWS_WITH(with_flow(point, 2.0), Contains("no stream"));
  CHECK_THROWS_WITH(with_density(point, 800.0), Contains("no stream"));
}

}  // namespace hood_test
