#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;
namespace fs = std::filesystem;

TEST_CASE("the summary of a design with a friction range shows every friction, and limits where they bind") {
  const Outcome outcome = glissade_run({"solve", shipped("grain_chute_with_limits")});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.output,
             Contains("low, 14 deg") && Contains("nominal, 17 deg") && Contains("high, 20 deg"));
  CHECK_THAT(outcome.output, Contains("low friction") && Contains("Stalls from       a friction angle of"));
}

TEST_CASE("ride keeps the track and changes the friction alone") {
  const Outcome outcome =
      glissade_run({"ride", shipped("grain_chute_with_limits"), "--friction-angle", "14deg,17deg,20deg,26deg",
                    "--friction-coefficient", "0.2", "--json"});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const json track = json::parse(outcome.output);
  REQUIRE(track["at_frictions"].size() == 5);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(track["at_frictions"][i]["travel_time_s"].get<double>() ==
          Approx(track["rides"][i]["travel_time_s"].get<double>()).epsilon(1e-12));
  }
  CHECK(track["at_frictions"][3]["status"] == "stalled");
  CHECK(track["at_frictions"][3]["travel_time_s"] == nullptr);
  CHECK(track["at_frictions"][3]["stall_margin_deg"].get<double>() < 0.0);
  CHECK(track["at_frictions"][4]["friction_coefficient"] == 0.2);
  // One friction at a time: a limit needs no word on where it binds.
  for (const json& check : track["at_frictions"][0]["limits"]) CHECK(check["friction"] == nullptr);
  CHECK_THAT(
      glissade_run({"ride", shipped("grain_chute_with_limits"), "--friction-angle", "14deg,26deg"}).output,
      Contains("found at 17 deg") && Contains("stalls after") && Contains("limits kept"));
  // Which limits a friction breaks is what is asked for, not how many they are.
  CHECK_THAT(glissade_run({"ride", shipped("grain_chute_with_limits"), "--friction-angle", "5deg"}).output,
             Contains("breaks ") && Contains("speed.highest"));
}

TEST_CASE("ride shifts all of a friction that changes along the track by the same angle") {
  const std::string file = shipped("toboggan_run_with_mats");
  const Outcome outcome = glissade_run({"ride", file, "--friction-angle", "5deg,7deg,12deg", "--json"});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const json track = json::parse(outcome.output);
  double before = 0.0;
  for (const json& ride : track["at_frictions"]) {
    // More friction all along is slower; past the stall margin the body does not arrive.
    const bool stalls = ride["stall_margin_deg"].get<double>() < 0.0;
    CHECK((ride["status"] == "stalled") == stalls);
    if (stalls) continue;
    CHECK(ride["travel_time_s"].get<double>() > before);
    before = ride["travel_time_s"].get<double>();
  }
  CHECK(before > 0.0);
  // At the design's own friction it is the design's own ride.
  const double own = track["friction_angle_deg"].get<double>();
  const Outcome same =
      glissade_run({"ride", file, "--friction-angle", std::to_string(own) + "deg", "--json"});
  CHECK(json::parse(same.output)["at_frictions"][0]["travel_time_s"].get<double>() ==
        Approx(track["travel_time_s"].get<double>()).epsilon(1e-5));
}

TEST_CASE(
    "ride tells of every friction at which some of the track would have none or too much, and rides at "
    "none") {
  const TempDir place;
  const std::string file = (place / "d.yaml").string();
  put_bytes(file,
            "glissade: 1\n"
            "track: {start: {x: 0 m, z: 10 m}}\n"
            "body: {friction: [{from: 0 m, angle: 20 deg}, {from: 5 m, angle: 8 deg}]}\n"
            "centerline: {kind: segments, entry_slope_angle: 30 deg, segments: [{length: 10 m}]}\n");
  const Outcome refused = glissade_run({"ride", file, "--friction-angle", "5deg,25deg,11deg"});
  CHECK(refused.exit_code == 2);
  CHECK(refused.output.empty());
  CHECK_THAT(refused.errors, Contains(":3:") &&
                                 Contains("8 deg from 5 m on would be -7 deg with 5 deg at the start") &&
                                 Contains("would be -1 deg with 11 deg at the start") &&
                                 !Contains("25 deg") && Contains("Try: at least 12 deg at the start"));
  CHECK(glissade_run({"ride", file, "--friction-angle", "12deg,25deg"}).exit_code == 0);
}

TEST_CASE("ride asks for a friction, and names the option that is wrong") {
  const Outcome none = glissade_run({"ride", shipped("grain_chute")});
  CHECK(none.exit_code == 2);
  CHECK_THAT(none.errors, Contains("no friction is given") && Contains("--friction-angle 14deg"));
  CHECK_THAT(glissade_run({"ride", shipped("grain_chute"), "--friction-angle", "14deg,,15deg"}).errors,
             Contains("--friction-angle: an empty text is not a number"));
  CHECK_THAT(glissade_run({"ride", shipped("grain_chute"), "--friction-angle", "14"}).errors,
             Contains("--friction-angle: 14 has no unit"));
  CHECK_THAT(glissade_run({"ride", shipped("grain_chute"), "--friction-coefficient", "-1"}).errors,
             Contains("--friction-coefficient: friction coefficient -1 is out of range"));
}

TEST_CASE("the JSON of limits that no track keeps has every key of a track") {
  const std::vector<std::string> impossible = {"--set", "limits.arc_length.highest=5m", "--json"};
  const std::string design = shipped("grain_chute_with_limits");
  const Outcome found = glissade_run({"solve", design, "--json"});
  std::vector<std::string> arguments = {"solve", design};
  arguments.insert(arguments.end(), impossible.begin(), impossible.end());
  const Outcome none = glissade_run(arguments);
  REQUIRE(none.exit_code == 3);
  const json with = json::parse(found.output);
  const json without = json::parse(none.output);
  for (const auto& [key, value] : with.items()) {
    INFO(key);
    CHECK(without.contains(key));
  }
  for (const auto& [key, value] : with["search"].items()) {
    INFO(key);
    CHECK(without["search"].contains(key));
  }
  CHECK(without["travel_time_s"] == nullptr);
  CHECK(with["search"]["conflict"] == nullptr);
}

TEST_CASE(
    "survey of the upper part tells the load that it is designed for there, and what lies before the start") {
  const std::string hill = shipped("hills/garmisch_hs142");
  const std::string points = bytes_of(fs::path(hill).parent_path() / "garmisch_survey.csv");
  std::size_t end = 0;
  for (int line = 0; line < 16; ++line) end = points.find('\n', end) + 1;
  const TempDir place;
  const std::string file = (place / "top.csv").string();
  // 0.9 m before the start, on the line of the track.
  put_bytes(file, points.substr(0, end) + "Z0,-90.9265,47.7189\n");
  const std::vector<std::string> arguments = {"survey", hill, file, "--offset", "120mm"};
  const Outcome text = glissade_run(arguments);
  INFO(text.output);
  CHECK(text.exit_code == 1);  // most of the track has no points
  CHECK_THAT(text.output, Contains("Z0 lies 90") && Contains("before the start, and is held against it") &&
                              Contains("without what was built 90") &&
                              Contains("before the start of the design"));
  std::vector<std::string> as_json = arguments;
  as_json.emplace_back("--json");
  const json told = json::parse(glissade_run(as_json).output);
  CHECK(told["from_m"] == 0.0);
  CHECK(told["before_start_m"].get<double>() == Approx(0.9).margin(0.01));
  // Straight down at 35 deg: g cos, far below what the bend asks for.
  CHECK(told["designed_max_normal_load_m_per_s2"].get<double>() ==
        Approx(9.81 * std::cos(35.0 * std::acos(-1.0) / 180.0)).epsilon(1e-6));
  CHECK(told["as_built"]["exit_speed_m_per_s"].get<double>() ==
        Approx(told["designed_speed_at_end_m_per_s"].get<double>()).epsilon(1e-3));
}
