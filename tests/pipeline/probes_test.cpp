#include "glissade/pipeline/probes.hpp"

#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

namespace probes_test {

using namespace glissade;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

const std::string kStraight =
    "glissade: 1\n"
    "track: {start: {x: 2 m, z: 5 m}, finish: {x: 6 m, z: 2 m}}\n"
    "body: {friction_coefficient: {low: 0.1, nominal: 0.3, high: 0.4}}\n"
    "centerline: {kind: straight}\n";

std::string refusal(const std::string& probes) {
  try {
    static_cast<void>(parse_design(kStraight + "probes: " + probes + "\n", "d.yaml"));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("probes at the x of either end are on the track, wherever rounding puts its ends") {
  for (const char* kind : {"fastest", "cycloid", "constant-speed"}) {
    for (int i = 0; i < 20; ++i) {
      const std::string finish = std::to_string(4.0 + 0.173 * i);
      const Design design =
          parse_design("glissade: 1\ntrack: {start: {x: 0.7 m, z: 5.3 m}, finish: {x: " + finish +
                           " m, z: 2.1 m}}\nbody: {friction_coefficient: 0.2}\ncenterline: {kind: " + kind +
                           "}\nprobes: [{x: 0.7 m}, {x: " + finish + " m}]\n",
                       "d.yaml");
      const Track track = solve(design);
      CAPTURE(kind, finish);
      const std::vector<ProbeReading> probes = probe_readings(design, track);
      REQUIRE(probes.size() == 2);
      CHECK(probes[0].point.arc_length == 0.0);
      CHECK(probes[1].point.arc_length == Approx(track.centerline->length()).epsilon(1e-9));
    }
  }
}

TEST_CASE("probes on a straight ramp: the closed form of its motion, at every friction") {
  const Design design = parse_design(
      kStraight + "probes: [{from_start: 2 m}, {from_finish: 1 m, name: sill}, {x: 4 m}]\n", "d.yaml");
  const Track track = solve(design);
  const std::vector<ProbeReading> probes = probe_readings(design, track);
  REQUIRE(probes.size() == 3);
  CHECK(probes[0].name == "2 m from the start");
  CHECK(probes[1].name == "sill");
  CHECK(probes[2].name == "x = 4 m");
  // 5 m long, sine 0.6, cosine 0.8.
  const double places[] = {2.0, 4.0, 2.5};
  const double frictions[] = {0.1, 0.3, 0.4};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(probes[i].point.arc_length == Approx(places[i]).epsilon(1e-12));
    CHECK(probes[i].position.x == Approx(2.0 + 0.8 * places[i]).epsilon(1e-12));
    CHECK(probes[i].position.z == Approx(5.0 - 0.6 * places[i]).epsilon(1e-12));
    REQUIRE(probes[i].states.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const double acceleration = 9.81 * (0.6 - frictions[k] * 0.8);
      CHECK(probes[i].states[k].motion->speed ==
            Approx(std::sqrt(2.0 * acceleration * places[i])).epsilon(1e-10));
      CHECK(probes[i].states[k].motion->normal_load == Approx(9.81 * 0.8).epsilon(1e-10));
    }
  }
  const json document = json::parse(track_json(design, track));
  REQUIRE(document["probes"].size() == 3);
  CHECK(document["probes"][1]["states"][2]["friction"] == "high");
  CHECK(document["probes"][1]["states"][2]["speed_m_per_s"] == probes[1].states[2].motion->speed);
}

TEST_CASE("a track that leads the other way is probed at the same places") {
  std::string text = kStraight + "probes: [{x: 4 m}]\n";
  text.replace(text.find("x: 6 m"), 6, "x: 0 m");
  text.replace(text.find("x: 4 m"), 6, "x: 1 m");
  const Design design = parse_design(text, "d.yaml");
  const std::vector<ProbeReading> probes = probe_readings(design, solve(design));
  REQUIRE(probes.size() == 1);
  CHECK(probes[0].position.x == Approx(1.0));
}

TEST_CASE("a probe beside the track is left out, with a warning that names it") {
  const Design design =
      parse_design(kStraight + "probes: [{from_start: 7 m}, {x: 1 m}, {x: 6 m}]\n", "d.yaml");
  const Track track = solve(design);
  CHECK(probe_readings(design, track).size() == 1);
  const std::vector<Issue> found = warnings(design, track);
  REQUIRE(found.size() == 2);
  CHECK_THAT(found[0].what, Contains("probes[0], 7 m from the start, does not lie on the track"));
  CHECK_THAT(found[1].what, Contains("probes[1], x = 1 m"));
}

TEST_CASE("a probe has exactly one place, of the right sign and dimension") {
  CHECK_THAT(refusal("[{name: here}]"), Contains("probes[0] has no place"));
  CHECK_THAT(refusal("[{x: 1 m, from_start: 1 m}]"), Contains("probes[0] has more than one place"));
  CHECK_THAT(refusal("[{from_start: -1 m}]"), Contains("from_start: -1 m is negative"));
  CHECK_THAT(refusal("[{from_start: 3 s}]"), Contains("not a length"));
  CHECK_THAT(refusal("[{from_strat: 3 m}]"),
             Contains("unknown key from_strat") && Contains("Try: from_start"));
  CHECK_THAT(refusal("{x: 1 m}"), Contains("probes is a group of keys, not a list"));
}

TEST_CASE("a lowest speed that begins to hold behind the end is told") {
  std::string text = kStraight + "limits: {speed: {lowest: 3 m/s, lowest_from: 30 m}}\n";
  const Design design = parse_design(text, "d.yaml");
  const std::vector<Issue> found = warnings(design, solve(design));
  REQUIRE(found.size() == 1);
  CHECK_THAT(found[0].what,
             Contains("speed.lowest holds from 30 m on, but the track ends after 5 m: it never applies"));
}

TEST_CASE("a line to stay above or below that covers little of the track is told, either way it runs") {
  const auto told = [](const std::string& start, const std::string& finish, const std::string& limits) {
    const Design design =
        parse_design("glissade: 1\ntrack: {start: {x: " + start + ", z: 5 m}, finish: {x: " + finish +
                         ", z: 2 m}}\nbody: {friction_angle: 10 deg}\n"
                         "centerline: {kind: straight}\nlimits: {" +
                         limits + "}\n",
                     "d.yaml");
    return warnings(design, solve(design));
  };
  const auto ground = [](const std::string& unit) {
    return "stay_above: [{line: [[2 " + unit + ", 0 m], [3 " + unit + ", 0 m], [4 " + unit + ", 0 m], [5 " +
           unit + ", 0 m], [6 " + unit + ", 0 m]]}]";
  };
  for (const auto& [start, finish] : {std::pair("2 m", "6 m"), std::pair("6 m", "2 m")}) {
    INFO(start);
    CHECK(told(start, finish, ground("m")).empty());
    const std::vector<Issue> in_mm = told(start, finish, ground("mm"));
    REQUIRE(in_mm.size() == 1);
    CHECK(in_mm[0].what == "stay_above[0] covers 0 mm of the 4 m that the track runs");
    CHECK(in_mm[0].where == "d.yaml:5:23");
    CHECK_THAT(in_mm[0].hint, Contains("unit"));
    // Part of a survey, and an obstacle's top as short.
    CHECK(told(start, finish,
               "stay_below: [{line: [[5 m, 9 m], [5.3 m, 9 m], [5.6 m, 9 m], [5.8 m, 9 m], [7 m, 9 m]]}]")
              .at(0)
              .what == "stay_below[0] covers 1 m of the 4 m that the track runs");
    CHECK(told(start, finish, "stay_below: [{line: [[5 m, 9 m], [7 m, 9 m]]}]").empty());
  }
}

TEST_CASE(
    "a width or a friction that is given beyond the end of the track is told, one on the track is not") {
  const Design design = parse_design(
      "glissade: 1\n"
      "track: {start: {x: 2 m, z: 5 m}, finish: {x: 6 m, z: 2 m}}\n"
      "body: {friction: [{from: 0 m, angle: 10 deg}, {from: 4.9 m, angle: 12 deg}, {from: 6 m, angle: 9 "
      "deg}]}\n"
      "centerline: {kind: straight}\n"
      "cross_section: {kind: u-channel, width: [{at: 0 m, width: 500 mm}, {at: 5 m, width: 400 mm}, "
      "{at: 7 m, width: 300 mm}], wall_height: 200 mm, thickness: 3 mm}\n",
      "d.yaml");
  const std::vector<Issue> found = warnings(design, solve(design));
  REQUIRE(found.size() == 2);
  CHECK(found[0].what == "a width is given at 7 m, but the track ends after 5 m");
  CHECK_THAT(found[0].where, Contains("d.yaml:5:"));
  CHECK(found[1].what == "friction changes at 6 m, but the track ends after 5 m");
}

TEST_CASE("the only width that is given, beyond the end of the track, is told as well") {
  const Design design = parse_design(
      "glissade: 1\n"
      "track: {start: {x: 2 m, z: 5 m}, finish: {x: 6 m, z: 2 m}}\n"
      "body: {friction_angle: 10 deg}\n"
      "centerline: {kind: straight}\n"
      "cross_section: {kind: u-channel, width: [{at: 50 m, width: 600 mm}], wall_height: 200 mm, "
      "thickness: 3 mm}\n",
      "d.yaml");
  const std::vector<Issue> found = warnings(design, solve(design));
  REQUIRE(found.size() == 1);
  CHECK(found[0].what == "the only width is given at 50 m, but the track ends after 5 m");
  CHECK_THAT(found[0].where, Contains("d.yaml:5:"));
}

TEST_CASE("a probe behind where a ride ends: its place is told, and no state of the body there") {
  // 4 m at 30 deg, then level: at 17 deg the body stalls on the level, at 5 deg it arrives.
  const Design design = parse_design(
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 3 m}}\n"
      "body: {friction_angle: {low: 5 deg, nominal: 17 deg}}\n"
      "centerline:\n"
      "  kind: segments\n"
      "  entry_slope_angle: 30 deg\n"
      "  segments: [{length: 4 m}, {to_slope_angle: 0 deg, radius: 3 m}, {length: 6 m}]\n"
      "probes: [{from_start: 1 m}, {x: 9 m, name: late}]\n",
      "d.yaml");
  const Track track = solve(design);
  const auto stall = track.motion.stall();
  REQUIRE(stall);
  const std::vector<ProbeReading> probes = probe_readings(design, track);
  REQUIRE(probes.size() == 2);
  REQUIRE(probes[1].point.arc_length > track.motion.distance());
  REQUIRE(probes[1].states.size() == 2);
  CHECK(probes[0].states[0].motion.has_value());
  CHECK(probes[0].states[1].motion.has_value());
  CHECK(probes[1].states[0].motion.has_value());
  CHECK_FALSE(probes[1].states[1].motion.has_value());
  CHECK(probes[1].position.x == Approx(9.0));
  for (const Issue& warning : warnings(design, track)) CHECK_THAT(warning.what, !Contains("probes["));

  const json document = json::parse(track_json(design, track));
  const json& states = document["probes"][1]["states"];
  CHECK(document["probes"][1]["x_m"] == Approx(9.0));
  CHECK(states[0]["speed_m_per_s"].is_number());
  for (const char* const key : {"time_s", "speed_m_per_s", "normal_load_m_per_s2"}) {
    INFO(key);
    CHECK(states[1][key].is_null());
  }
}

}  // namespace probes_test
