#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/pipeline.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <memory>
#include <string>

#include <fmt/format.h>

namespace constant_speed_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

Design drawn(double drop, const std::string& body, const std::string& p = "") {
  return parse_design(fmt::format("glissade: 1\ntrack: {{start: {{x: 0 m, z: {} m}}, finish: {{x: 10 m, z: 0 "
                                  "m}}}}\nbody: {{{}}}\ncenterline: {{kind: constant-speed{}}}\n",
                                  drop, body, p),
                      "d.yaml");
}

const ConstantSpeedCurve& curve_of(const Track& track) {
  return dynamic_cast<const ConstantSpeedCurve&>(*track.centerline);
}

}  // namespace

TEST_CASE("constant-speed without p: with drag, too, no P of a scan brings the body sooner") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr double kLikewise = 1e-9;  // accuracy: of a ride's time, with a margin
  double gained = 0.0;
  for (int draw = 0; draw < 12; ++draw) {
    const double mu = std::pow(10.0, random.between(-1.5, 0.0));
    const double drop = 10.0 * mu * (1.0 + std::pow(10.0, random.between(-1.5, 0.7)));
    const double speed = draw % 3 == 0 ? 0.0 : random.between(0.5, 15.0);
    const double drag = std::pow(10.0, random.between(-2.5, 0.0));
    CAPTURE(mu, drop, speed, drag);
    const Track track = solve(drawn(
        drop, fmt::format("friction_coefficient: {}, entry_speed: {} m/s, drag: {} 1/m", mu, speed, drag)));
    REQUIRE(track.motion.arrived());
    const double found = track.motion.travel_time();
    const Friction friction = Friction::from_coefficient(mu);
    const double smallest = ConstantSpeedCurve::smallest_p(track.endpoints, friction, 9.80665);
    const auto time_at = [&](double p) {
      const auto curve = std::make_shared<ConstantSpeedCurve>(track.endpoints, friction, 9.80665, p);
      const Motion motion(curve, track.motion.body(), 9.80665);
      return motion.arrived() ? motion.travel_time() : HUGE_VAL;
    };
    for (int step = 0; step <= 60; ++step) {
      const double p = smallest * std::exp(0.2 * step);
      CAPTURE(p);
      CHECK(time_at(p) > found * (1.0 - kLikewise));
    }
    const auto dragless =
        ConstantSpeedCurve::fastest(track.endpoints, friction, 9.80665, track.motion.body().entry_speed);
    gained = std::max(gained, time_at(dragless.p()) / found - 1.0);
  }
  CHECK(gained > 0.005);
}

TEST_CASE("constant-speed without p: next to no drag the P found by rides is that of the closed form") {
  for (const double speed : {0.0, 3.0}) {
    const std::string body = fmt::format("friction_coefficient: 0.3, entry_speed: {} m/s", speed);
    const Track calm = solve(drawn(5.0, body));
    const Track ridden = solve(drawn(5.0, body + ", drag: 1e-300 1/m"));
    CHECK(curve_of(ridden).p() == Approx(curve_of(calm).p()).epsilon(1e-6));
    CHECK(ridden.motion.travel_time() == Approx(calm.motion.travel_time()).epsilon(1e-12));
  }
}

TEST_CASE(
    "constant-speed: a speed is told as kept where a ride that begins with it keeps it, and only there") {
  struct Case {
    std::string body;
    double drop;
    double p;
    bool keeps;
  };
  const std::string slide = "friction_coefficient: 0.3";
  for (const Case& one :
       {Case{slide, 5.0, 200.0, true}, Case{slide, 2.0, 150.0, true}, Case{slide, 1.0, 200.0, false},
        Case{slide, 2.5, 400.0, true}, Case{slide + ", drag: 0.01 1/m", 5.0, 200.0, false},
        Case{slide + ", centre_height: 0.2 m", 5.0, 200.0, false}}) {
    CAPTURE(one.body, one.drop, one.p);
    const double speed = std::sqrt(one.p);
    const Design design = drawn(one.drop, one.body + fmt::format(", entry_speed: {} m/s", speed),
                                fmt::format(", p: {} m^2/s^2", one.p));
    const CenterlinePtr centerline = make_centerline(design);
    const Track track = ride(design, centerline);
    const auto kept = kept_speed(curve_of(track), track.motion.body());
    CHECK(kept.has_value() == one.keeps);
    const bool rides_on = track.motion.arrived() &&
                          std::fabs(track.motion.exit_speed() / speed - 1.0) < 1e-9 &&
                          std::fabs(track.motion.highest_speed().speed / speed - 1.0) < 1e-9;
    CHECK(rides_on == one.keeps);
    if (kept) CHECK(*kept == Approx(speed).epsilon(1e-12));
    Body other = track.motion.body();
    other.friction = Friction::from_coefficient(0.31);
    CHECK_FALSE(kept_speed(curve_of(track), other));
  }
}

TEST_CASE("constant-speed: a stream keeps the speed of its even depth, not that of a p of its own") {
  const std::string text =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 5 m, z: 0 m}}\n"
      "body: {friction_angle: 20 deg, entry_speed: 9.5 m/s}\n"
      "stream: {mass_flow: 300 t/h, bulk_density: 800 kg/m^3}\ncenterline: {kind: constant-speed}\n"
      "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string other = text;
    other.replace(other.find(from), from.size(), to);
    return parse_design(other, "d.yaml");
  };
  const Track even = solve(parse_design(text, "d.yaml"));
  const auto kept = kept_speed(curve_of(even), even.motion.body());
  REQUIRE(kept);
  CHECK(*kept == Approx(9.5).epsilon(1e-12));
  const Track own = solve(with("kind: constant-speed", "kind: constant-speed, p: 90.25 m^2/s^2"));
  CHECK(std::fabs(own.motion.exit_speed() - 9.5) > 0.01);
  CHECK_FALSE(kept_speed(curve_of(own), own.motion.body()));
  for (const std::string drag : {"drag: 0.05 1/m", "mass: 2 kg, drag_area: 0.1 m^2"}) {
    CAPTURE(drag);
    CHECK_THROWS_WITH(
        solve(with("9.5 m/s", "9.5 m/s, " + drag)),
        Contains("constant-speed without p, of a stream with drag") && Contains("objective: even_speed"));
  }
}

}  // namespace constant_speed_test
