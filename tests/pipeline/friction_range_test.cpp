#include "glissade/motion/stall_friction.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace friction_range_test {

using namespace glissade;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

const std::string kRange =
    "glissade: 1\n"
    "track: {start: {x: 0 m, z: 5 m}, finish: {x: 8 m, z: 0 m}}\n"
    "body:\n"
    "  friction_angle: {low: 9 deg, nominal: 11 deg, high: 14 deg}\n";

Design design_with(const std::string& text) {
  return parse_design(kRange + text, "d.yaml");
}

}  // namespace

TEST_CASE("a friction range is ridden at its ends, each like a design of that friction on the same track") {
  const Design design = design_with("limits: {speed: {highest: 7.4 m/s}, smallest_radius: 1 m}\n");
  const Track track = solve(design);
  const std::vector<LevelRide> rides = track.rides();
  REQUIRE(rides.size() == 3);
  CHECK(rides[1].motion == &track.motion);
  for (const LevelRide& ride : rides) {
    const Track again = ride_at(design, track.centerline, ride.motion->body().friction);
    CHECK(again.motion.travel_time() == ride.motion->travel_time());
    CHECK(again.motion.exit_speed() == ride.motion->exit_speed());
    CHECK(again.range.empty());
  }
  CHECK(rides[0].motion->travel_time() < rides[1].motion->travel_time());
  CHECK(rides[1].motion->travel_time() < rides[2].motion->travel_time());
}

TEST_CASE("every limit on motion tells the friction at which it binds, and reaches what that ride reaches") {
  const Track track =
      solve(design_with("limits: {speed: {highest: 7.4 m/s}, exit_speed: {lowest: 1 m/s}}\n"));
  bool highest = false;
  bool exit = false;
  for (const LimitCheck& check : track.limit_checks) {
    if (check.limit.key() == "speed.highest") {
      highest = true;
      CHECK(check.friction == FrictionLevel::low);
      CHECK(check.reached == Approx(track.rides().front().motion->highest_speed().speed).epsilon(1e-4));
    }
    if (check.limit.key() == "exit_speed.lowest") {
      exit = true;
      CHECK(check.friction == FrictionLevel::high);
      CHECK(check.reached == track.rides().back().motion->exit_speed());
    }
    if (check.limit.key() == "finish") CHECK_FALSE(check.friction);
  }
  CHECK(highest);
  CHECK(exit);
  const std::string single =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 8 m, z: 0 m}}\n"
      "body: {friction_angle: 11 deg}\nlimits: {speed: {highest: 7 m/s}}\n";
  for (const LimitCheck& check : solve(parse_design(single, "d.yaml")).limit_checks)
    CHECK_FALSE(check.friction);
}

TEST_CASE(
    "a range needs no limits: a drawn track is ridden over it, and a stall at its high end is a problem") {
  const std::string straight = "centerline: {kind: straight}\n";
  const Design design = design_with(straight);
  const Track track = solve(design);
  CHECK(track.range.size() == 2);
  CHECK_FALSE(ride_problem(design, track));

  // The fastest track for 11 deg climbs at its end: at 14 deg the body does not come up there.
  const Design steep = parse_design(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 8 m, z: 0 m}}\n"
      "body: {friction_angle: {nominal: 11 deg, high: 13.9 deg}}\n",
      "d.yaml");
  const Track bold = solve(steep);
  const auto problem = ride_problem(steep, bold);
  REQUIRE(problem);
  CHECK_THAT(problem->what, Contains("at high friction, 13.9 deg, the body stalls after"));
  CHECK_THAT(problem->hint, Contains("limits: {}"));
}

TEST_CASE("the JSON of rides agrees with the rides") {
  const Design design = design_with("limits: {}\n");
  const Track track = solve(design);
  const json document = json::parse(track_json(design, track));
  REQUIRE(document["rides"].size() == 3);
  const std::optional<Angle> stall = stall_angle_of(track);
  REQUIRE(stall);
  for (std::size_t i = 0; i < 3; ++i) {
    const json& entry = document["rides"][i];
    const Motion& motion = *track.rides()[i].motion;
    CHECK(entry["friction"] == std::string(to_text(track.rides()[i].level)));
    CHECK(entry["travel_time_s"] == motion.travel_time());
    CHECK(entry["highest_speed_m_per_s"] == motion.highest_speed().speed);
    CHECK(entry["min_normal_load_m_per_s2"] == motion.lowest_load().normal_load);
    CHECK(entry["stall_margin_deg"].get<double>() ==
          Approx(stall->degrees() - motion.body().friction.angle().degrees()));
  }
  CHECK(document["travel_time_s"] == document["rides"][1]["travel_time_s"]);
}

TEST_CASE("a body that next to no more friction stops is warned of, at the highest friction of a range") {
  // A straight line carries a body from rest up to a friction angle of its own slope, atan(5/8).
  const auto told = [](const std::string& friction, const std::string& rest) {
    const Design design = parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 8 m, z: 0 m}}\n"
        "body: {friction_angle: " +
            friction + "}\n" + rest,
        "d.yaml");
    const std::vector<Issue> found = warnings(design, solve(design));
    return found.empty() ? std::string() : found.front().what + " " + found.front().hint;
  };
  const double slope = std::atan(5.0 / 8.0) * 180.0 / std::numbers::pi;
  const auto below = [&](double by) { return fmt::format("{:.6f} deg", slope - by); };
  const std::string straight = "centerline: {kind: straight}\n";
  CHECK_THAT(told(below(0.01), straight),
             Contains("a friction angle that is higher by less than 0.02 deg stops the body on this track") &&
                 Contains("a steeper track"));
  CHECK(told(below(0.03), straight).empty());
  const auto range = [&](double by) { return "{low: 9 deg, nominal: 11 deg, high: " + below(by) + "}"; };
  CHECK_THAT(told(range(0.01), straight), Contains("stops the body"));
  CHECK(told(range(0.03), straight).empty());
  // Drag takes the less the slower a body is: the highest exit speed is that of one that creeps.
  const std::string fast_exit =
      "limits: {objective: exit_speed, smallest_radius: 0.5 m, highest_normal_load: 3 g";
  const std::string dragged = "11 deg, drag: 0.1 1/m";
  CHECK_THAT(told(dragged, fast_exit + "}\n"), Contains("stops the body") && Contains("lowest_slope_margin"));
  CHECK(told(dragged, fast_exit + ", lowest_slope_margin: 1 deg}\n").empty());
}

namespace {

/// Frictions in degrees from 0 m and from 5 m on.
Design with_angles(const std::vector<double>& angles) {
  std::string list;
  for (std::size_t i = 0; i < angles.size(); ++i)
    list += fmt::format("{}{{from: {} m, angle: {} deg}}", i == 0 ? "" : ", ", 5 * i, angles[i]);
  return parse_design(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 10 m}}\nbody: {friction: [" + list +
          "]}\ncenterline: {kind: segments, entry_slope_angle: 30 deg, segments: [{length: 10 m}]}\n",
      "d.yaml");
}

Friction of_degrees(double angle) {
  return Friction::from_angle(Angle::from_degrees(angle));
}

/// Why a design cannot have another friction at its start; empty if it can.
std::string refusal(const Design& design, double angle) {
  try {
    const Design other = with_friction(design, of_degrees(angle), 100.0);
    for (std::size_t i = 0; i < other.body.friction_changes.size(); ++i) {
      const double by = other.body.friction_changes[i].friction.angle().degrees() -
                        design.body.friction_changes[i].friction.angle().degrees();
      CHECK(std::fabs(by - (angle - design.body.friction.angle().degrees())) < 1e-9);
    }
    CHECK(other.body.friction.angle().degrees() == Approx(angle).margin(1e-9));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("another friction at the start moves all along the track by the same angle, or is refused") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr double kSteepest = 89.9942;
  for (int i = 0; i < 200; ++i) {
    const std::vector<double> angles = {random.between(0.0, 60.0), random.between(0.0, 89.9),
                                        random.between(0.0, 89.9)};
    const double asked = random.between(0.0, 80.0);
    CAPTURE(angles, asked);
    const Design design = with_angles(angles);
    const auto [least, most] = std::minmax({angles[1], angles[2]});
    const double by = asked - angles[0];
    const std::string told = refusal(design, asked);
    CHECK(told.empty() == (least + by >= 0.0 && most + by <= kSteepest));
    if (told.empty()) continue;
    INFO(told);
    CHECK_THAT(told, Contains("d.yaml:3:") && Contains("friction: ") && Contains(" m on would be ") &&
                         Contains(" at the start") && Contains("between 0 deg and 89.994 deg"));
  }
}

TEST_CASE("friction that begins beyond the finish may be any, and has no effect") {
  const Design design = with_angles({20.0, 8.0});
  CHECK_THROWS_AS(with_friction(design, of_degrees(5.0), 5.1), InputError);
  CHECK_NOTHROW(with_friction(design, of_degrees(5.0), 4.9));
  const auto straight = [](const std::string& more) {
    return parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 10 m}}\nbody: {friction: [{from: 0 m, angle: 15 deg}" +
            more +
            "]}\ncenterline: {kind: segments, entry_slope_angle: 30 deg, segments: [{length: 10 m}]}\n",
        "d.yaml");
  };
  const Design plain = straight("");
  for (const std::string beyond : {", {from: 40 m, angle: 2 deg}", ", {from: 10 m, angle: 89.9 deg}"}) {
    const Design with = straight(beyond);
    const CenterlinePtr track = make_centerline(with);
    for (const double angle : {1.0, 5.0, 25.0}) {
      CHECK(ride_at(with, track, of_degrees(angle)).motion.travel_time() ==
            ride_at(plain, track, of_degrees(angle)).motion.travel_time());
    }
  }
}

TEST_CASE("what is refused for one friction along the track names that, and a friction that does") {
  const std::string told = refusal(with_angles({20.0, 8.0}), 5.0);
  CHECK_THAT(told, Contains("d.yaml:3:") &&
                       Contains("friction: 8 deg from 5 m on would be -7 deg with 5 deg at the start") &&
                       Contains("The start has 20 deg") && Contains("by -15 deg") &&
                       Contains("Try: at least 12 deg at the start"));
  CHECK(refusal(with_angles({20.0, 8.0}), 12.0).empty());
  const std::string steep = refusal(with_angles({20.0, 80.0}), 40.0);
  CHECK_THAT(steep, Contains("friction: 80 deg from 5 m on would be 100 deg") &&
                        Contains("Try: at most 29.99 deg at the start"));
  CHECK(refusal(with_angles({20.0, 80.0}), 29.99).empty());
  // Where nothing changes nothing is shifted, however steep.
  const Design own = with_angles({20.0, 89.95});
  CHECK(with_friction(own, own.body.friction, 100.0).body.friction_changes[1].friction ==
        own.body.friction_changes[1].friction);
}

}  // namespace friction_range_test
