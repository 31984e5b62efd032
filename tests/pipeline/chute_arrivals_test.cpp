// Cases of a chute that do not arrive: what chokes in a surge, stands where it lands or flies over the start, and what is
// told of them.

#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/rules.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <string>

#include <nlohmann/json.hpp>

namespace chute_arrivals_test {

using namespace glissade;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

std::string chute(const std::string& body, const std::string& stream, const std::string& ends,
                  const std::string& width = "300 mm", const std::string& more = "") {
  return "glissade: 1\ntrack: {start: {x: 0 m, z: 4 m}, finish: {" + ends + "}}\nbody: {" + body +
         "}\nstream: {" + stream + "}\ncenterline: {kind: straight}\n" +
         "cross_section: {kind: u-channel, width: " + width + ", wall_height: 900 mm, thickness: 8 mm}\n" +
         more;
}

/// Chokes in a surge at the highest friction, where it is exactly as deep as its channel is wide.
std::string choking(const std::string& surge = "2") {
  return chute(
      "friction_angle: {low: 28 deg, nominal: 29.5 deg, high: 31 deg}, entry_speed: 1 m/s",
      "mass_flow: 246.24 t/h, bulk_density: 1600 kg/m^3, lateral_pressure_ratio: 0.6, surge: " + surge,
      "x: 3 m, z: 1.3 m");
}

/// Falls 38.7 deg steeper than its floor: with 52 deg of friction it stands there.
std::string standing(const std::string& high = "52 deg", const std::string& ends = "x: 2 m, z: 1.5 m") {
  return chute("friction_angle: {low: 25 deg, nominal: 35 deg, high: " + high + "}",
               "mass_flow: 100 t/h, bulk_density: 1600 kg/m^3", ends, "800 mm",
               "feed: {kind: free-fall, drop: 1 m}\n");
}

std::string belt_fed(const std::string& friction, const std::string& feed) {
  return chute("friction_angle: " + friction, "mass_flow: 300 t/h, bulk_density: 1600 kg/m^3",
               "x: 2 m, z: 1 m", "800 mm", "feed: {kind: belt, pulley_radius: 400 mm, " + feed + "}\n");
}

Judgement verdict(const Design& design, const std::string& id) {
  for (const Judgement& one : judge_rules(design, solve(design))) {
    if (one.rule.id == id) return one;
  }
  FAIL("no rule " + id);
  return {};
}

Judgement verdict(const std::string& text, const std::string& id) {
  return verdict(parse_design(text, "d.yaml"), id);
}

/// The number before " deg" behind some words.
double degrees_after(const std::string& text, const std::string& words) {
  std::smatch found;
  REQUIRE(std::regex_search(text, found, std::regex(words + "([0-9.]+) deg")));
  return std::stod(found[1]);
}

void require_nulls(const json& told, std::initializer_list<const char*> keys) {
  for (const char* const key : keys) {
    INFO(key);
    REQUIRE(told.contains(key));
    CHECK(told[key].is_null());
  }
}

}  // namespace

TEST_CASE("a chute that chokes in a surge fails a rule that names case, place and why") {
  const Design design = parse_design(choking(), "d.yaml");
  const Track track = solve(design);
  CHECK_FALSE(ride_problem(design, track));  // at nominal flow it arrives at every friction
  const Judgement arrives = verdict(design, "chute.2.arrives");
  CHECK(arrives.verdict == RuleVerdict::fail);
  CHECK(arrives.value == 1.0);
  CHECK(arrives.place == "high friction, surge flow: choked");
  REQUIRE(arrives.arc_length);
  CHECK(*arrives.arc_length == Approx(0.1295).epsilon(1e-3));
  // The rule of thin streams is kept to the last digit there.
  CHECK(verdict(design, "chute.7.thin").verdict == RuleVerdict::pass);
  const Judgement calm = verdict(choking("1.5"), "chute.2.arrives");
  CHECK(calm.verdict == RuleVerdict::pass);
  CHECK(calm.value == 0.0);
}

TEST_CASE("what lifts off, stands or flies over the start does not arrive") {
  const auto place_of = [](const std::string& text) {
    const Judgement arrives = verdict(text, "chute.2.arrives");
    CHECK(arrives.verdict == RuleVerdict::fail);
    return arrives.place;
  };
  CHECK_THAT(place_of(standing()), Contains("high friction") && Contains(": stands where it lands"));
  CHECK_THAT(place_of(belt_fed("24 deg", "belt_speed: 3 m/s, drop: 50 mm")),
             Contains(": flies over the start"));
  const std::string crest =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 9 m}}\nbody: {friction_angle: 20 deg, entry_speed: 3 m/s}\n"
      "stream: {mass_flow: 100 t/h, bulk_density: 800 kg/m^3}\n"
      "centerline: {kind: segments, entry_slope_angle: 40 deg, segments: [{length: 2 m}, {length: 0.5 m, "
      "radius: -1 m}]}\n"
      "cross_section: {kind: u-channel, width: 600 mm, wall_height: 400 mm, thickness: 5 mm}\n";
  CHECK_THAT(place_of(crest), Contains(": lifted off"));
}

TEST_CASE("the stall margin is that of the surge at the lowest density") {
  const std::string stream =
      "mass_flow: 100 t/h, bulk_density: {low: 1400 kg/m^3, nominal: 1600 kg/m^3, high: "
      "1800 kg/m^3}, surge: 1.5";
  const std::string written = "mass_flow: 150 t/h, bulk_density: 1400 kg/m^3, surge: 1";
  const std::string body = "friction_angle: {low: 24 deg, nominal: 27 deg, high: 31 deg}, entry_speed: 2 m/s";
  const Judgement worst = verdict(chute(body, stream, "x: 3 m, z: 1 m"), "chute.2.stall-margin");
  const Design as_nominal = parse_design(chute(body, written, "x: 3 m, z: 1 m"), "d.yaml");
  const double margin = stall_angle_of(solve(as_nominal)).value().radians() - 31.0 * kDegree;
  CHECK(worst.value.value() == Approx(margin).margin(2e-6));
  CHECK(worst.place == "surge flow");
  // At the nominal flow it is more: what was told before.
  const Design nominal = parse_design(chute(body, stream, "x: 3 m, z: 1 m"), "d.yaml");
  CHECK(stall_angle_of(solve(nominal)).value().radians() - 31.0 * kDegree > margin + 1e-3);
}

TEST_CASE("faces converge where a channel is narrower than somewhere before") {
  const auto narrowing = [](const std::string& width) {
    return verdict(chute("friction_angle: 25 deg, entry_speed: 2 m/s",
                         "mass_flow: 100 t/h, bulk_density: 1000 kg/m^3", "x: 3 m, z: 1 m", width),
                   "chute.10.build-up");
  };
  const Judgement bulge =
      narrowing("[{at: 0 m, width: 600 mm}, {at: 1.5 m, width: 1200 mm}, {at: 3.5 m, width: 600 mm}]");
  CHECK(bulge.verdict == RuleVerdict::warn);
  CHECK(bulge.value.value() == Approx(0.5));
  CHECK(bulge.arc_length.value() == Approx(3.5));
  const Judgement widening = narrowing("[{at: 0 m, width: 600 mm}, {at: 3.5 m, width: 900 mm}]");
  CHECK(widening.verdict == RuleVerdict::pass);
  CHECK(widening.value == 1.0);
  // What narrows on beyond the finish counts as far as the track goes.
  const double length = std::hypot(3.0, 3.0);
  CHECK(narrowing("[{at: 0 m, width: 800 mm}, {at: 10 m, width: 400 mm}]").value.value() ==
        Approx(1.0 - 0.5 * length / 10.0));
}

TEST_CASE("a feed that stands where it lands says so, with values that help") {
  const Design design = parse_design(standing(), "d.yaml");
  const auto problem = ride_problem(design, solve(design));
  REQUIRE(problem);
  CHECK(problem->what ==
        "at high friction, 52 deg, the feed stands where it lands: friction takes all of its speed");
  CHECK_THAT(problem->why, Contains("38.7 deg steeper than the floor") && Contains("52 deg"));
  CHECK_THAT(problem->hint, !Contains("entry_speed") && !Contains("wider") && !Contains("flow"));
  const double friction = degrees_after(problem->hint, "friction angle of at most ");
  const Design slippery = parse_design(standing(std::to_string(friction) + " deg"), "d.yaml");
  CHECK_FALSE(ride_problem(slippery, solve(slippery)));
  CHECK(verdict(slippery, "chute.4.impact-ratio").verdict == RuleVerdict::pass);
  const double slope = degrees_after(problem->hint, "a floor of at least ");
  const double run = 2.5 / std::tan(slope * kDegree);
  const Design steep =
      parse_design(standing("52 deg", "x: " + std::to_string(run) + " m, z: 1.5 m"), "d.yaml");
  CHECK_FALSE(ride_problem(steep, solve(steep)));
  CHECK(verdict(steep, "chute.4.impact-ratio").verdict == RuleVerdict::pass);
}

TEST_CASE("a belt that is too slow for its floor is told how its feed has to fall") {
  // It begins flatter than its friction, and steepens.
  const auto fed = [](double belt_speed) {
    return parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 4 m}}\nbody: {friction_angle: 50 deg}\n"
        "stream: {mass_flow: 100 t/h, bulk_density: 1600 kg/m^3}\n"
        "centerline: {kind: segments, entry_slope_angle: 40 deg, "
        "segments: [{length: 0.16 m, radius: -0.5 m}, {length: 0.5 m}]}\n"
        "cross_section: {kind: u-channel, width: 800 mm, wall_height: 500 mm, thickness: 8 mm}\n"
        "feed: {kind: belt, pulley_radius: 20 mm, drop: 500 mm, belt_speed: " +
            std::to_string(belt_speed) + " m/s}\n",
        "d.yaml");
  };
  const Design slow = fed(0.46);
  const auto problem = ride_problem(slow, solve(slow));
  REQUIRE(problem);
  CHECK_THAT(problem->what, Contains("the feed stands where it lands"));
  CHECK_THAT(problem->hint, Contains("a faster belt"));
  // From the same height: the tangent is down over ahead.
  const double most = degrees_after(problem->hint, "falls at 40 deg to ");
  const Design faster = fed(std::sqrt(2.0 * 9.80665 * 0.5) / std::tan(most * kDegree));
  CHECK_FALSE(ride_problem(faster, solve(faster)));
  CHECK(verdict(faster, "chute.4.impact-ratio").verdict == RuleVerdict::pass);
  // On a straight floor that is flatter than the friction no feed keeps on: that is not advised.
  const Design flat = parse_design(belt_fed("58 deg", "belt_speed: 0.5 m/s, drop: 500 mm"), "d.yaml");
  const auto stands = ride_problem(flat, solve(flat));
  REQUIRE(stands);
  CHECK_THAT(stands->hint, !Contains("belt") && Contains("a floor of at least 66.6 deg"));
}

TEST_CASE("of what stands where it lands nothing is told that would follow from its impact") {
  const Design design = parse_design(standing(), "d.yaml");
  const json told = json::parse(track_json(design, solve(design)));
  const json& high = told["rides"][2];
  CHECK(high["status"] == "stands where it lands");
  require_nulls(high, {"travel_time_s", "highest_speed_m_per_s", "friction_loss_j_per_kg", "law_end"});
  require_nulls(high["stream"], {"max_depth_m", "highest_filling", "highest_equivalent_friction", "choke"});
  CHECK(high["stream"]["choked"] == false);
  CHECK(told["wear"]["friction"] != "high");  // what stands rubs nothing
  CHECK(verdict(design, "chute.2.stall").value == 0.0);
  CHECK(verdict(design, "chute.4.impact-ratio").value == 0.0);
  CHECK(verdict(design, "chute.7.depth").value.value() < 1.0);
}

TEST_CASE("of what flies over the start nothing is told that would follow from its impact") {
  const Design design = parse_design(
      belt_fed("{low: 20 deg, nominal: 24 deg, high: 28 deg}", "belt_speed: 3 m/s, drop: 50 mm"), "d.yaml");
  const Track track = solve(design);
  const json told = json::parse(track_json(design, track));
  CHECK(told["status"] == "flies over the start");
  require_nulls(told, {"travel_time_s", "exit_speed_m_per_s", "entry_speed_m_per_s", "highest_speed_m_per_s",
                       "highest_speed_at_m", "max_normal_load_m_per_s2", "friction_loss_j_per_kg",
                       "drag_loss_j_per_kg", "law_end"});
  require_nulls(told["stream"], {"max_depth_m", "max_depth_at_m", "exit_depth_m", "highest_filling", "choke",
                                 "highest_equivalent_friction", "choking_mass_flow_kg_per_s"});
  for (const auto& [key, value] : told["wear"].items()) {
    INFO(key);
    CHECK(value.is_null());
  }
  CHECK_FALSE(stall_angle_of(track));
  require_nulls(told["rides"][0], {"stall_friction_angle_deg", "stall_margin_deg"});
  CHECK(verdict(design, "chute.2.stall-margin").verdict == RuleVerdict::cannot_be_judged);
  CHECK(verdict(design, "chute.8.speed").verdict == RuleVerdict::cannot_be_judged);
}

TEST_CASE("limits on motion are held against no ride that flies over its start") {
  std::string text =
      belt_fed("{low: 20 deg, nominal: 24 deg, high: 28 deg}", "belt_speed: 3 m/s, drop: 50 mm");
  text += "limits: {speed: {highest: 1 m/s}, slope_angle: {highest: 80 deg}}\n";
  const Design design = parse_design(text, "d.yaml");
  const Track track = solve(design);
  REQUIRE(ride_end(track.motion) == RideEnd::flies_over_start);
  const auto check_of = [&](LimitId id) {
    return std::find_if(track.limit_checks.begin(), track.limit_checks.end(),
                        [&](const LimitCheck& check) { return check.limit.id == id; });
  };
  CHECK(check_of(LimitId::speed) == track.limit_checks.end());
  CHECK(check_of(LimitId::lowest_normal_load) == track.limit_checks.end());
  REQUIRE(check_of(LimitId::slope_angle) != track.limit_checks.end());
  CHECK(check_of(LimitId::slope_angle)->violation == 0.0);
  for (const LimitId arrival : {LimitId::arrival_at_low_friction, LimitId::arrival_at_high_friction}) {
    REQUIRE(check_of(arrival) != track.limit_checks.end());
    CHECK(check_of(arrival)->reached == 0.0);
    CHECK(check_of(arrival)->violation > 0.0);
  }
}

}  // namespace chute_arrivals_test
