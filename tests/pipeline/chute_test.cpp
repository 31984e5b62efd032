// A chute from feed to belt: what a design tells of its ends, the checklist that it is held against, and what must move
// which way when one thing changes.

#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/rules.hpp"
#include "glissade/trades/chute/stream.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace chute_test {

using namespace glissade;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A straight spoon: 100 t/h of ore fall on it and leave to a belt.
std::string spoon(const std::string& more = "", const std::string& friction = "friction_angle: 27 deg") {
  return "glissade: 1\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 2 m, z: 0.6 m}}\nbody: {" + friction +
         "}\nstream: {mass_flow: 100 t/h, bulk_density: 1600 kg/m^3, lump_size: 60 mm}\n"
         "feed: {kind: belt, belt_speed: 2 m/s, pulley_radius: 300 mm, drop: 1 m}\n"
         "discharge: {belt_speed: 3 m/s, drop: 300 mm}\ncenterline: {kind: straight}\n"
         "cross_section: {kind: u-channel, width: 600 mm, wall_height: 400 mm, thickness: 8 mm}\n" +
         more;
}

const Judgement& verdict(const std::vector<Judgement>& all, const std::string& id) {
  for (const Judgement& one : all) {
    if (one.rule.id == id) return one;
  }
  FAIL("no rule " + id);
  return all.front();
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  REQUIRE(at != std::string::npos);
  return text.replace(at, part.size(), by);
}

std::string problems(const std::string& text) {
  try {
    static_cast<void>(parse_design(text, "d.yaml"));
    return {};
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("feed and discharge of a straight spoon, by hand") {
  const Design design = parse_design(spoon(), "d.yaml");
  const Track track = solve(design);
  REQUIRE(track.motion.arrived());
  const json document = json::parse(track_json(design, track));
  // v^2/(g R) = 1.36: it leaves the pulley at once, level.
  const double speed = std::sqrt(4.0 + 2.0 * 9.81);
  const double falls = std::atan2(std::sqrt(2.0 * 9.81), 2.0);
  const double slope = std::atan2(2.4, 2.0);
  const double phi = 27.0 * std::acos(-1.0) / 180.0;
  const json& feed = document["feed"];
  CHECK(feed["speed_m_per_s"].get<double>() == Approx(speed).epsilon(1e-12));
  CHECK(feed["speed_ratio"].get<double>() ==
        Approx(std::cos(falls - slope + phi) / std::cos(phi)).epsilon(1e-12));
  CHECK(document["entry_speed_m_per_s"].get<double>() ==
        Approx(speed * feed["speed_ratio"].get<double>()).epsilon(1e-12));
  CHECK(feed["pulley_run_m"].get<double>() == Approx(-2.0 * std::sqrt(2.0 / 9.81)).epsilon(1e-12));
  CHECK(feed["pulley_height_m"].get<double>() == Approx(1.0 - 0.3).epsilon(1e-12));
  const json& belt = document["discharge"];
  const double exit = track.motion.exit_speed();
  CHECK(belt["speed_along_belt_m_per_s"].get<double>() == Approx(exit * std::cos(slope)).epsilon(1e-12));
  CHECK(belt["speed_into_belt_m_per_s"].get<double>() ==
        Approx(std::sqrt(std::pow(exit * std::sin(slope), 2) + 2.0 * 9.81 * 0.3)).epsilon(1e-12));
}

namespace {

/// The cases of one flow, by friction, all they tell flattened.
std::vector<json> cases_of(const std::string& text, const std::string& flow) {
  const Design design = parse_design(text, "d.yaml");
  const json document = json::parse(track_json(design, solve(design)));
  std::vector<json> cases;
  for (json one : document["cases"]) {
    if (one["flow"] != flow) continue;
    one.erase("flow");
    cases.push_back(one.flatten());
  }
  return cases;
}

}  // namespace

TEST_CASE("each case is told as the nominal stream of a design that is written with its flow and density") {
  const std::string range = "friction_angle: {low: 24 deg, nominal: 27 deg, high: 31 deg}";
  const std::string hood = "hood: {radius: 0.7 m, impact_angle: 15 deg, exit_angle: 70 deg, drop: 300 mm}\n";
  const std::string fast = replaced(spoon("", range), "belt_speed: 2 m/s, pulley_radius: 300 mm, drop: 1 m",
                                    "belt_speed: 3.2 m/s, pulley_radius: 400 mm, drop: 150 mm");
  for (const std::string& chute : {spoon("", range), fast + hood}) {
    const auto with = [&](const std::string& stream) {
      return replaced(chute, "mass_flow: 100 t/h, bulk_density: 1600 kg/m^3", stream);
    };
    const std::string ranged = with(
        "mass_flow: 100 t/h, surge: 1.5, trickle: 0.25, bulk_density: {low: 1400 kg/m^3, nominal: 1600 "
        "kg/m^3, high: 1800 kg/m^3}");
    // A surge is at the lowest density, the others at the nominal one.
    for (const auto& [flow, stream] : std::vector<std::pair<std::string, std::string>>{
             {"surge", "mass_flow: 150 t/h, bulk_density: 1400 kg/m^3"},
             {"trickle", "mass_flow: 25 t/h, bulk_density: 1600 kg/m^3"},
             {"nominal", "mass_flow: 100 t/h, bulk_density: 1600 kg/m^3"}}) {
      const std::vector<json> cases = cases_of(ranged, flow);
      const std::vector<json> written = cases_of(with(stream + ", surge: 1, trickle: 1"), "nominal");
      REQUIRE(cases.size() == 3);
      REQUIRE(written.size() == 3);
      for (std::size_t i = 0; i < cases.size(); ++i) {
        REQUIRE(cases[i].size() == written[i].size());
        CHECK(cases[i].contains("/discharge/belt_wear_w_per_m2"));
        for (const auto& [key, value] : cases[i].items()) {
          INFO(flow << " " << key);
          if (value.is_number()) {
            CHECK(value.get<double>() == Approx(written[i].at(key).get<double>()).epsilon(1e-9).margin(1e-9));
          } else {
            CHECK(value == written[i].at(key));
          }
        }
      }
    }
  }
}

TEST_CASE("a chute is held against the checklist at every friction and flow, worst case named") {
  const Design design =
      parse_design(spoon("", "friction_angle: {low: 24 deg, nominal: 27 deg, high: 31 deg}"), "d.yaml");
  const Track track = solve(design);
  const std::vector<Judgement> all = judge_rules(design, track);
  CHECK(all.size() >= 20);
  const double slope = std::atan2(2.4, 2.0) * 180.0 / std::acos(-1.0);
  const Judgement& margin = verdict(all, "chute.3.slope");
  CHECK(*margin.value * 180.0 / std::acos(-1.0) == Approx(slope - 31.0).epsilon(1e-9));
  CHECK(margin.verdict == RuleVerdict::pass);
  const Judgement& depth = verdict(all, "chute.7.depth");
  CHECK_THAT(depth.place, Contains("high friction, surge flow"));
  const Judgement& slow = verdict(all, "chute.2.stall");
  CHECK_THAT(slow.place, Contains("high friction, surge flow"));
  CHECK(verdict(all, "chute.7.lump").value == Approx(10.0));
  CHECK(verdict(all, "chute.12.structure").verdict == RuleVerdict::cannot_be_judged);
  CHECK_THAT(verdict(all, "chute.12.structure").reason, Contains("3.77 kN on each metre"));
  const json document = json::parse(track_json(design, track));
  CHECK(document["verdicts"].size() == all.size());
  CHECK(document["cases"].size() == 9);
  for (const json& entry : document["verdicts"]) {
    CHECK_FALSE(entry["source"].get<std::string>().empty());
    CHECK(entry["needs_checking"] == true);
  }
}

TEST_CASE("each verdict turns when what it is about does") {
  const auto judged = [](const std::string& text, const char* id) {
    const Design design = parse_design(text, "d.yaml");
    return verdict(judge_rules(design, solve(design)), id).verdict;
  };
  CHECK(judged(spoon(), "chute.7.lump") == RuleVerdict::pass);
  CHECK(judged(replaced(spoon(), "lump_size: 60 mm", "lump_size: 150 mm"), "chute.7.lump-running") ==
        RuleVerdict::warn);
  CHECK(judged(spoon(), "chute.7.depth") == RuleVerdict::pass);
  CHECK(judged(replaced(spoon(), "wall_height: 400 mm", "wall_height: 18 mm"), "chute.7.depth") ==
        RuleVerdict::fail);
  CHECK(judged(replaced(spoon(), "27 deg", "46 deg"), "chute.3.slope") == RuleVerdict::fail);
  CHECK(judged(replaced(spoon(), "{belt_speed: 3 m/s", "{belt_speed: 9 m/s"), "chute.6.belt") ==
        RuleVerdict::fail);
  CHECK(judged(replaced(spoon(), "drop: 1 m}", "drop: 2 m}"), "chute.4.fall") == RuleVerdict::warn);
  CHECK(judged(replaced(
                   replaced(spoon(),
                            "feed: {kind: belt, belt_speed: 2 m/s, pulley_radius: 300 mm, drop: 1 m}\n", ""),
                   "27 deg", "27 deg, entry_speed: 2 m/s"),
               "chute.4.impact-ratio") == RuleVerdict::cannot_be_judged);
}

TEST_CASE("a feed that flies over the start is a problem with a way out") {
  const Design design = parse_design(replaced(spoon(), "drop: 1 m}", "drop: 50 mm}"), "d.yaml");
  const auto problem = ride_problem(design, solve(design));
  REQUIRE(problem);
  CHECK_THAT(problem->what, Contains("the feed flies over the start"));
  CHECK_THAT(problem->hint, Contains("entry_slope_angle"));
}

TEST_CASE("nothing follows from an impact that does not take place") {
  const Design design = parse_design(replaced(spoon(), "drop: 1 m}", "drop: 50 mm}"), "d.yaml");
  const Track track = solve(design);
  CHECK_FALSE(lands(track.motion));
  const std::vector<Judgement> all = judge_rules(design, track);
  const Judgement& landing = verdict(all, "chute.4.landing");
  CHECK(landing.verdict == RuleVerdict::fail);
  CHECK(*landing.value ==
        Approx(std::atan2(std::sqrt(2.0 * 9.81 * 0.05), 2.0) - std::atan2(2.4, 2.0)).epsilon(1e-12));
  for (const char* const id : {"chute.2.stall", "chute.4.impact-ratio", "chute.4.impact-angle",
                               "chute.5.contact", "chute.6.belt", "chute.7.depth", "chute.9.wear"}) {
    INFO(id);
    CHECK(verdict(all, id).verdict == RuleVerdict::cannot_be_judged);
  }
  CHECK_THAT(verdict(all, "chute.4.impact-ratio").reason, Contains("flies over the start"));
  const json told = json::parse(track_json(design, track));
  CHECK(told["status"] == "flies over the start");
  CHECK(told["cases"][0]["status"] == "flies over the start");
  for (const char* const key : {"travel_time_s", "exit_speed_m_per_s", "entry_speed_m_per_s", "discharge"}) {
    INFO(key);
    CHECK(told[key].is_null());
  }
  for (const char* const key :
       {"impact_angle_deg", "speed_ratio", "entry_speed_m_per_s", "impact_pressure_pa"}) {
    INFO(key);
    CHECK(told["feed"][key].is_null());
  }
  CHECK(told["feed"]["angle_deg"].is_number());
  CHECK(told["wear"]["highest_floor_wear_w_per_m2"].is_null());
  // A feed along the floor lands, and keeps its speed.
  const Design along =
      parse_design(replaced(spoon(), "kind: belt, belt_speed: 2 m/s, pulley_radius: 300 mm, drop: 1 m",
                            "kind: free-fall, drop: 1 m"),
                   "d.yaml");
  CHECK(verdict(judge_rules(along, solve(along)), "chute.4.landing").verdict == RuleVerdict::pass);
}

TEST_CASE("ends that cannot be are refused") {
  CHECK_THAT(problems(replaced(spoon(), "drop: 1 m}", "drop: 0 m}")), Contains("never meets the floor"));
  CHECK_THAT(problems(replaced(spoon(), "27 deg", "27 deg, entry_speed: 2 m/s")),
             Contains("entry_speed: beside a feed"));
  CHECK_THAT(problems(replaced(spoon(), "pulley_radius: 300 mm, ", "")), Contains("pulley_radius"));
  CHECK_THAT(problems(replaced(spoon(), "kind: belt, belt_speed: 2 m/s, pulley_radius: 300 mm",
                               "kind: hopper, belt_speed: 2 m/s")),
             Contains("kind: belt, which has belt_speed"));
  const std::string fed =
      replaced(replaced(spoon("limits: {match_belt: {speed: 9 m/s}}\n"),
                        "feed: {kind: belt, belt_speed: 2 m/s, pulley_radius: 300 mm, drop: 1 m}\n", ""),
               "27 deg", "27 deg, entry_speed: 2 m/s");
  CHECK_THAT(problems(fed), Contains("a belt of 9 m/s is faster than the stream can be, 7.148 m/s"));
  // The fall of the feed counts, and what leaves its pulley.
  CHECK_THAT(problems(spoon("limits: {match_belt: {speed: 12 m/s}}\n")),
             Contains("match_belt: a belt of 12 m/s is faster than the stream can be, 8.") &&
                 Contains("free fall from the feed to finish"));
  const Design fast = parse_design(
      replaced(spoon(), "discharge: {belt_speed: 3 m/s", "discharge: {belt_speed: 12 m/s"), "d.yaml");
  const std::vector<Issue> told = warnings(fast, solve(fast));
  const auto says = [&](const std::string& words) {
    return std::any_of(told.begin(), told.end(),
                       [&](const Issue& issue) { return issue.what.find(words) != std::string::npos; });
  };
  CHECK(says("the belt is faster than the stream can be: 12 m/s, along it the stream has at most 8."));
}

TEST_CASE("the search chooses how steep to start with what the impact leaves") {
  std::string text = replaced(spoon("limits: {concave: true, smallest_valley_radius: 1 m}\n"),
                              "kind: straight", "kind: fastest");
  const Design design = parse_design(text, "d.yaml");
  const Track best = solve(design);
  REQUIRE(best.search);
  REQUIRE(best.motion.arrived());
  const double start = best.centerline->slope_angle(0.0);
  CHECK(start <= feed_fall(design).landing.angle.radians() + 1e-6);
  // Held a little steeper or flatter, it is never faster.
  for (const double away : {-0.05, 0.05}) {
    Design held = design;
    held.limits->entry_slope_angle = Range::fixed(start + away);
    double time = 0.0;
    try {
      time = solve(held).motion.travel_time();
    } catch (const InfeasibleError&) {
      CHECK(away > 0.0);  // steeper than the feed falls
      continue;
    }
    CHECK(time >= best.motion.travel_time() * (1.0 - 1e-7));
  }
}

TEST_CASE("match_belt: the stream leaves with the belt's level speed, at every friction") {
  const std::string text =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 2.2 m, z: 0 m}}\n"
      "body: {friction_angle: {low: 24 deg, nominal: 27 deg, high: 30 deg}, entry_speed: 2 m/s}\n"
      "stream: {mass_flow: 300 t/h, bulk_density: 1600 kg/m^3}\ncenterline: {kind: fastest}\n"
      "limits: {match_belt: {speed: 3.4 m/s, within: 12 %}, smallest_radius: 0.5 m}\n"
      "cross_section: {kind: u-channel, width: 600 mm, wall_height: 400 mm, thickness: 8 mm}\n";
  const Design design = parse_design(text, "d.yaml");
  const Track track = solve(design);
  for (const LevelRide& ride : track.rides()) {
    const double level =
        ride.motion->exit_speed() * std::cos(track.centerline->slope_angle(track.centerline->length()));
    CHECK(std::fabs(level / 3.4 - 1.0) <= 0.12 + 1e-5);
  }
  Design open = design;
  open.limits->match_belt.reset();
  CHECK(solve(open).motion.travel_time() <= track.motion.travel_time() * (1.0 + 1e-9));
}

TEST_CASE("a material gives friction, density and pressure ratio, and what is given beside it counts") {
  const std::string base =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 6 m}, finish: {x: 4 m, z: 1 m}}\nbody: {entry_speed: 2 m/s}\n"
      "stream: {mass_flow: 60 t/h, material: wheat, liner: mild-steel, moisture: 14 %}\n"
      "centerline: {kind: straight}\n"
      "cross_section: {kind: u-channel, width: 300 mm, wall_height: 200 mm, thickness: 3 mm}\n";
  const Design design = parse_design(base, "d.yaml");
  CHECK(design.body.low_friction->angle().degrees() == Approx(15.5));
  CHECK(design.body.high_friction->angle().degrees() == Approx(24.0));
  CHECK(design.stream->low_density == 765.0);
  CHECK(design.stream->lateral_pressure_ratio == 0.54);
  const std::vector<Issue> told = warnings(design, solve(design));
  REQUIRE(told.size() == 2);
  CHECK_THAT(told[1].what, Contains("from the library, not measured for this chute"));
  const Design own = parse_design(replaced(base, "body: {", "body: {friction_angle: 20 deg, "), "d.yaml");
  CHECK(own.body.friction.angle().degrees() == Approx(20.0));
  CHECK_FALSE(own.body.high_friction);
  CHECK(own.stream->low_density == 765.0);
  CHECK_THAT(problems(replaced(base, "material: wheat", "material: weat")), Contains("Try: wheat, or"));
  CHECK_THAT(problems(replaced(base, "mild-steel", "mild-steal")), Contains("mild-steel"));
  CHECK_THAT(problems(replaced(base, ", liner: mild-steel", "")), Contains("without a liner"));
  CHECK_THAT(problems(replaced(base, "mild-steel", "rubber")),
             Contains("nothing is known of wheat on rubber"));
  const Design entry = parse_design(
      replaced(
          replaced(base, "material: wheat, liner: mild-steel, moisture: 14 %",
                   "material: our-seed, liner: our-plate"),
          "centerline:",
          "materials:\n  - {material: our-seed, density: {nominal: 700 kg/m^3, source: weighed}, friction: "
          "[{liner: our-plate, angle: {low: 18 deg, high: 22 deg}, source: shear test}]}\ncenterline:"),
      "d.yaml");
  CHECK(entry.body.friction.angle().degrees() == Approx(20.0));
  CHECK(entry.stream->bulk_density == 700.0);
  CHECK(warnings(entry, solve(entry)).empty());
}

TEST_CASE("the shipped chutes with streams arrive, and fail no rule that a program can judge") {
  for (const char* const name : {"grain_chute_with_stream", "ore_transfer", "powder_chute_with_stream"}) {
    INFO(name);
    const Design design = read_design(designs_path(std::string(name) + ".yaml"));
    const Track track = solve(design);
    CHECK_FALSE(ride_problem(design, track));
    CHECK_FALSE(limits_problem(design, track));
    for (const Judgement& one : judge_rules(design, track)) {
      INFO(one.rule.id << " " << one.value.value_or(0.0) << " " << one.place);
      CHECK(one.verdict != RuleVerdict::fail);
    }
  }
}

TEST_CASE("slopes are judged by the friction of their place, wherever along the track it is highest") {
  const auto judged = [](double first, double second, double third, double from) {
    const std::string list = "{from: 0 m, angle: " + std::to_string(first) +
                             " deg}, {from: 2 m, angle: " + std::to_string(second) +
                             " deg}, {from: " + std::to_string(from) + " m, angle: " + std::to_string(third) +
                             " deg}";
    return parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 30 m}}\nbody: {friction: [" + list +
            "], entry_speed: 4 m/s}\nstream: {mass_flow: 60 kg/s, bulk_density: 900 kg/m^3}\n"
            "centerline: {kind: segments, entry_slope_angle: 38 deg, segments: [{length: 4 m}]}\n"
            "limits: {lowest_slope_margin: 0 deg}\n"
            "cross_section: {kind: u-channel, width: 600 mm, wall_height: 400 mm, thickness: 6 mm}\n",
        "d.yaml");
  };
  for (const auto& [frictions, from] :
       {std::pair{std::vector{15.0, 36.0, 20.0}, 3.0}, std::pair{std::vector{36.0, 15.0, 20.0}, 3.0},
        std::pair{std::vector{20.0, 15.0, 36.0}, 3.0}, std::pair{std::vector{15.0, 20.0, 36.0}, 4.0},
        std::pair{std::vector{15.0, 20.0, 36.0}, 5.0}}) {
    CAPTURE(frictions, from);
    const Design design = judged(frictions[0], frictions[1], frictions[2], from);
    const Track track = solve(design);
    const std::vector<Judgement> all = judge_rules(design, track);
    const double highest = from < 4.0 ? 36.0 : 20.0;
    const Judgement& slope = verdict(all, "chute.3.slope");
    CHECK(slope.value.value() == Approx((38.0 - highest) * kDegree).margin(1e-12));
    CHECK((slope.verdict == RuleVerdict::pass) == (highest == 20.0));
    CHECK((verdict(all, "chute.3.slope-10").verdict == RuleVerdict::pass) == (highest == 20.0));
    // The limit of that name has it from the referee.
    for (const LimitCheck& check : track.limit_checks) {
      if (check.limit.id == LimitId::lowest_slope_margin && from != 4.0)
        CHECK(check.reached == Approx(slope.value.value()).margin(1e-9));
    }
    bool valley = false;
    for (const Judgement& one : all) valley = valley || one.rule.id == "chute.3.valley";
    CHECK(valley == (highest == 36.0));
    // That friction changes along the track does not make it known as a range.
    CHECK(verdict(all, "chute.1.material").value.value() == 0.0);
  }
}

TEST_CASE("a plugged chute carries what its section holds, leaning walls too") {
  const auto told = [](const std::string& section) {
    const Design design = parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 3 m, z: 1 m}}\n"
        "body: {friction_angle: 25 deg, entry_speed: 2 m/s}\n"
        "stream: {mass_flow: 10 t/h, bulk_density: 1000 kg/m^3}\ncenterline: {kind: straight}\n"
        "cross_section: {" +
            section + "}\n",
        "d.yaml");
    return verdict(judge_rules(design, solve(design)), "chute.12.structure").reason;
  };
  CHECK_THAT(told("kind: u-channel, width: 400 mm, wall_height: 400 mm, thickness: 6 mm"),
             Contains("full of material it carries 1.57 kN on each metre"));
  CHECK_THAT(told("kind: trapezoid, width: 400 mm, wall_height: 400 mm, wall_angle: 0 deg, thickness: 6 mm"),
             Contains("full of material it carries 1.57 kN on each metre"));
  CHECK_THAT(told("kind: trapezoid, width: 400 mm, wall_height: 400 mm, wall_angle: 60 deg, thickness: 6 mm"),
             Contains("full of material it carries 4.29 kN on each metre"));
  CHECK_THAT(told("kind: trapezoid, width: 600 mm, wall_height: 300 mm, wall_angle: 30 deg, thickness: 6 mm"),
             Contains("full of material it carries 2.28 kN on each metre"));
  CHECK_THAT(told("kind: trapezoid, width: [{at: 0 m, width: 600 mm}, {at: 2 m, width: 400 mm}], "
                  "wall_height: 400 mm, "
                  "wall_angle: 60 deg, thickness: 6 mm"),
             Contains("full of material it carries 5.07 kN on each metre"));
  CHECK_THAT(told("kind: slab, width: 400 mm, thickness: 20 mm, curb_height: 400 mm, curb_width: 20 mm"),
             Contains("full of material it carries 1.57 kN on each metre"));
}

TEST_CASE("a stream that moves away from its belt does not land, and is not judged as one that does") {
  const auto with = [](const std::string& belt, const std::string& friction = "25 deg") {
    return parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}}\nbody: {friction_angle: " + friction +
            ", entry_speed: 2 m/s}\nstream: {mass_flow: 100 t/h, bulk_density: 900 kg/m^3}\n"
            "discharge: {belt_speed: 4.6 m/s, " +
            belt +
            "}\ncenterline: {kind: segments, entry_slope_angle: 60 deg, segments: "
            "[{length: 1.5 m}, {to_slope_angle: 30 deg, radius: 3 m}]}\n"
            "cross_section: {kind: u-channel, width: 600 mm, wall_height: 300 mm, thickness: 6 mm}\n",
        "d.yaml");
  };
  const auto warned = [](const Design& design, const Track& track) {
    for (const Issue& issue : warnings(design, track)) {
      if (to_text(issue).find("does not land on its belt") != std::string::npos) return to_text(issue);
    }
    return std::string();
  };
  const Design away = with("belt_angle: -45 deg, drop: 50 mm");
  const Track track = solve(away);
  const json told = json::parse(track_json(away, track));
  CHECK(told["discharge"].is_null());
  for (const json& one : told["cases"]) CHECK(one["discharge"].is_null());
  const std::vector<Judgement> all = judge_rules(away, track);
  CHECK(verdict(all, "chute.6.belt").verdict == RuleVerdict::cannot_be_judged);
  CHECK_THAT(verdict(all, "chute.6.belt").reason, Contains("it moves away from its belt"));
  CHECK_THAT(warned(away, track), Contains("at 1.08") && Contains("comes from below"));
  // It lands with more drop; where it does at the lowest friction alone that is told, too.
  const Design lower = with("belt_angle: -45 deg, drop: 900 mm");
  CHECK(warned(lower, solve(lower)).empty());
  CHECK(verdict(judge_rules(lower, solve(lower)), "chute.6.belt").value);
  CHECK(json::parse(track_json(lower, solve(lower)))["discharge"]["speed_into_belt_m_per_s"] > 0.0);
  const Design ranged =
      with("belt_angle: -39.2 deg, drop: 300 mm", "{low: 5 deg, nominal: 25 deg, high: 26 deg}");
  CHECK_THAT(warned(ranged, solve(ranged)), Contains("at low friction, 5 deg, the stream does not land"));
  // The others land, at another speed than the belt's: that breaks the rule whatever the one that does not would do.
  const Track with_range = solve(ranged);
  CHECK(verdict(judge_rules(ranged, with_range), "chute.6.belt").verdict == RuleVerdict::fail);
  CHECK_THAT(rule_measurements(ranged, with_range).find("belt_match")->missing().value(),
             Contains("low friction") && Contains("moves away from its belt"));
}

}  // namespace chute_test
