// Limits from the design file to what the user is told: the search, the checks, prices, conflicts, early
// ends.

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace limits_test {

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr const char* kInrun =
    "glissade: 1\n"
    "name: In-run\n"
    "track: {start: {x: 0 m, z: 47.08 m}, finish: {x: 90.23 m, z: 0 m}}\n"
    "body: {friction_coefficient: 0.03}\n"
    "limits:\n"
    "  slope_angle: {highest: 35 deg}\n"
    "  exit_slope_angle: 11 deg\n"
    "  lead_out: 6.9 m\n"
    "  highest_curvature_load: 7.14 m/s^2\n"
    "  concave: true\n"
    "cross_section: {kind: slab, width: 2 m, thickness: 100 mm}\n"
    "mesh: {tolerance: 20 mm}\n"
    "export: [stl]\n";

/// A design file for as long as a test runs.
class DesignFile {
 public:
  explicit DesignFile(const std::string& text) { put_bytes(place_ / "design.yaml", text); }
  [[nodiscard]] std::string path() const { return (place_ / "design.yaml").string(); }
  [[nodiscard]] std::filesystem::path place() const { return place_.path(); }

 private:
  TempDir place_;
};

Outcome solve(const DesignFile& file, std::vector<std::string> arguments = {}) {
  arguments.insert(arguments.begin(), {"solve", file.path()});
  return glissade_run(arguments);
}

json solved(const DesignFile& file, std::vector<std::string> arguments = {}) {
  arguments.push_back("--json");
  const Outcome outcome = solve(file, arguments);
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  return json::parse(outcome.output);
}

json check_of(const json& track, const std::string& limit) {
  for (const json& check : track["limits"]) {
    if (check["limit"] == limit) return check;
  }
  FAIL(limit << " is not among the limits of " << track.dump());
  return {};
}

}  // namespace

TEST_CASE("solve finds the fastest track within limits and reports every one of them") {
  const DesignFile file(kInrun);
  const json track = solved(file);
  CHECK(track["centerline"] == "fastest");
  CHECK(track["search"]["status"] == "optimal");
  CHECK(track["search"]["first_order_residual"].get<double>() <= 1e-6);
  CHECK(track["search"]["finer_mesh_wins"].get<double>() <= 1e-6);
  CHECK(track["search"]["excess_over_unlimited"].get<double>() > 0.0);
  CHECK(track["search"]["rounds"].get<int>() > 0);
  CHECK(track["exit_slope_angle_deg"].get<double>() == Approx(11.0).epsilon(1e-6));
  CHECK(track["travel_time_s"].get<double>() > track["optimum_travel_time_s"].get<double>());
  for (const json& check : track["limits"]) {
    INFO(check.dump());
    CHECK(check["kept"] == true);
    CHECK(check["violation_of_scale"].get<double>() <= 1e-6);
  }
  CHECK(check_of(track, "slope_angle.highest")["reached"].get<double>() == Approx(35.0).epsilon(1e-6));
  CHECK(check_of(track, "lead_out")["reached"].get<double>() >= 6.9 * (1.0 - 1e-6));
  CHECK(check_of(track, "highest_curvature_load")["unit"] == "m/s^2");
}

TEST_CASE("the price of a limit in the report is what a re-solve with one unit more wins") {
  const DesignFile file(kInrun);
  const json track = solved(file);
  const double steeper =
      solved(file, {"--set", "limits.slope_angle.highest=35.2deg"})["travel_time_s"].get<double>();
  const double flatter =
      solved(file, {"--set", "limits.slope_angle.highest=34.8deg"})["travel_time_s"].get<double>();
  for (const json& active : track["search"]["active"]) {
    // The limit's own row tells the same.
    CHECK(check_of(track, active["limit"])["price"] == active["price"]);
    if (active["limit"] != "slope_angle.highest") continue;
    CHECK(active["price_unit"] == "s per deg");
    CHECK(active["price"].get<double>() == Approx((flatter - steeper) / 0.4).epsilon(0.02));
    CHECK(active["where"][0]["from_m"].get<double>() < 1.0);
    return;
  }
  FAIL("slope_angle.highest is not active");
}

TEST_CASE("a track is called after what was searched for") {
  const std::string text =
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0.2}\n"
      "limits: {slope_angle: {lowest: 15 deg}, smallest_radius: 1 m, objective: ";
  const Outcome fastest = solve(DesignFile(text + "travel_time}\n"));
  CHECK_THAT(fastest.output, Contains("fastest within the limits") && !Contains(" 0 rounds"));
  const Outcome swift = solve(DesignFile(text + "exit_speed}\n"));
  CHECK_THAT(swift.output, Contains("of the highest exit speed within the limits") &&
                               Contains("no neighbouring track has a higher exit speed") &&
                               !Contains("fastest within") && !Contains("is faster"));
}

TEST_CASE(
    "where two limits bind at one place, relief and tightening have prices of their own, in every output") {
  const DesignFile file(R"(
glissade: 1
track: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}
body: {friction_coefficient: 0.2}
centerline: {kind: fastest}
limits:
  slope_angle: {lowest: 15 deg}
  speed: {highest: 6.9777 m/s}
  exit_speed: {highest: 6.9777 m/s}
)");
  const json track = solved(file);
  CHECK(check_of(track, "slope_angle.lowest")["price"] ==
        check_of(track, "slope_angle.lowest")["tightening_price"]);
  CHECK(check_of(track, "slope_angle.lowest")["price_unit"] == "s per deg");
  CHECK(check_of(track, "lowest_normal_load")["price"].is_null());
  for (const char* key : {"speed.highest", "exit_speed.highest"}) {
    INFO(key);
    const json check = check_of(track, key);
    CHECK(check["price"].get<double>() == Approx(0.0).margin(1e-9));
    CHECK(check["tightening_price"].get<double>() == Approx(0.0700).epsilon(0.02));
    CHECK(check["where"].size() == 1);
  }
  CHECK_THAT(solve(file).output, Contains("0 s per m/s looser, 0.07 tighter"));
}

TEST_CASE("the summary shows limits, what was reached, where, and prices") {
  const Outcome outcome = solve(DesignFile(kInrun));
  CHECK_THAT(outcome.output, Contains("fastest within the limits") &&
                                 Contains("optimal: every limit holds") && Contains("slope_angle.highest") &&
                                 Contains("<= 35 deg") && Contains("s per deg") &&
                                 Contains("more than the least possible without"));
}

TEST_CASE("build makes a valid solid of the fastest track within limits") {
  const DesignFile file(kInrun);
  const Outcome outcome =
      glissade_run({"build", file.path(), "-o", (file.place() / "out").string(), "--json"});
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  const json built = json::parse(outcome.output);
  CHECK(built["mesh"]["valid"] == true);
  CHECK(built["search"]["status"] == "optimal");
}

TEST_CASE("a limit that is missed by a hair is told with the digits that show it") {
  const DesignFile file(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 2 m}, finish: {x: 3 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0.2}\ncenterline: {kind: straight}\n"
      "limits: {slope_angle: {highest: 33.69 deg}, speed: {highest: 5.2407 m/s}}\n");
  const Outcome outcome = solve(file);
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("slope_angle.highest 33.69 deg is broken by") &&
                                 Contains("(33.6901 deg after 0 mm)") &&
                                 Contains("speed.highest 5.2407 m/s is broken by"));
}

TEST_CASE("a redesign whose table alone is too fast has exit code 3, as a search that ends early has 4") {
  const TempDir place;
  const std::string long_table =
      "rules={own: [{id: own.t, sentence: Long., quantity: table_length, lowest: 400 m, source: a test}]}";
  const auto outcome_for = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"redesign", shipped("hills/garmisch_hs142"), "--time-budget", "1ms"});
    return glissade_run(arguments, {place.path(), {}, {}});
  };
  const Outcome fast = outcome_for({"--set", long_table, "-o", "made.yaml", "--json"});
  CHECK(fast.exit_code == 3);
  CHECK_THAT(
      fast.errors,
      Contains(
          "there is no free shape: the table alone, 400 m, gives more than the take-off speed: 28.06 m/s "
          "from rest, 27.07 m/s are asked for; it would take a shorter table, or a higher speed") &&
          Contains("Whatever lies above the table, a body enters it with no less than that."));
  CHECK_FALSE(std::filesystem::exists(place / "made.yaml"));
  const json search = json::parse(fast.output)["search"];
  CHECK(search["status"] == "infeasible");
  CHECK_THAT(search["message"].get<std::string>(), Contains("the table alone, 400 m"));
  const Outcome high = outcome_for({"--set", long_table, "--for", "exit-speed"});
  CHECK(high.exit_code == 3);
  CHECK_THAT(high.errors, Contains("the table alone, 400 m, drops by 76.32 m, which leaves nothing of the "
                                   "in-run's 47.1 m; it would take a shorter one"));
  const Outcome area = outcome_for({"--speed", "5m/s"});
  CHECK(area.exit_code == 3);
  CHECK_THAT(area.errors, Contains("start area and table alone, 24 m and 1.25 m, give more than the take-off "
                                   "speed: 8.796 m/s from rest, 5 m/s are asked for"));
  CHECK(outcome_for({}).exit_code == 4);
}

TEST_CASE("a track of another kind is held against the limits, and a broken one has exit code 3") {
  const DesignFile file(kInrun);
  const Outcome outcome = solve(file, {"--set", "centerline.kind=straight", "--json"});
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors,
             Contains("design.yaml:7:21: this track breaks limits of the design: exit_slope_angle 11 deg") &&
                 Contains("is broken by 16.55 deg") && Contains("of kind straight is not shaped by limits"));
  const json track = json::parse(outcome.output);
  CHECK(track["search"].is_null());
  CHECK(check_of(track, "slope_angle.highest")["kept"] == true);
  const json exit = check_of(track, "exit_slope_angle");
  CHECK(exit["kept"] == false);
  // atan(47.08/90.23) against 11 deg.
  CHECK(exit["reached"].get<double>() == Approx(27.55454).epsilon(1e-6));

  const auto out = file.place() / "out";
  const Outcome build =
      glissade_run({"build", file.path(), "-o", out.string(), "--set", "centerline.kind=straight"});
  CHECK(build.exit_code == 3);
  CHECK_FALSE(std::filesystem::exists(out));
  // Limits that it keeps are no obstacle.
  CHECK(solve(file, {"--set", "centerline.kind=straight", "--set", "limits={slope_angle: {highest: 35 deg}}"})
            .exit_code == 0);
}

TEST_CASE("limits on segments are checked on both sides of a jump of curvature") {
  const DesignFile file(
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 9 m}}\n"
      "body: {friction_coefficient: 0.1}\n"
      "centerline:\n"
      "  kind: segments\n"
      "  entry_slope_angle: 60 deg\n"
      "  segments: [{length: 4 m}, {length: 2 m, radius: 4 m}, {length: 3 m}]\n"
      "limits: {smallest_valley_radius: 5 m, highest_curvature_rate: 10 1/m^2, lead_in: 3 m, lead_out: 5 "
      "m}\n");
  const Outcome outcome = solve(file, {"--json"});
  CHECK(outcome.exit_code == 3);
  const json track = json::parse(outcome.output);
  CHECK(check_of(track, "smallest_valley_radius")["reached"].get<double>() == Approx(4.0));
  CHECK(check_of(track, "smallest_valley_radius")["violation"].get<double>() == Approx(1.0));
  CHECK(check_of(track, "highest_curvature_rate")["reached"].is_null());
  CHECK(check_of(track, "highest_curvature_rate")["kept"] == false);
  CHECK(check_of(track, "lead_in")["kept"] == true);
  CHECK(check_of(track, "lead_in")["reached"].get<double>() == Approx(4.0).epsilon(1e-3));
  CHECK(check_of(track, "lead_out")["reached"].get<double>() == Approx(3.0).epsilon(1e-3));
  CHECK_THAT(outcome.errors, Contains("lead_out 5 m is broken by 2 m"));
}

TEST_CASE("limits that contradict each other are named with the smallest relaxations, and exit code 3") {
  const DesignFile file(kInrun);
  const Outcome outcome =
      solve(file, {"--set", "limits.smallest_valley_radius=150m", "--set", "limits.concave=false", "--set",
                   "body.drag=0.0013 1/m", "--set", "limits.lead_in=20m", "--json"});
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("exit_slope_angle 11 deg") && Contains("slope_angle.highest 35 deg") &&
                                 Contains("smallest_valley_radius 150 m") &&
                                 Contains("cannot be met together") && Contains("Try: ") &&
                                 Contains("each alone would do"));
  const json report = json::parse(outcome.output);
  CHECK(report["status"] == "infeasible");
  CHECK(report["travel_time_s"].is_null());
  // The straight line knows no limits.
  const Outcome without = solve(file, {"--set", "limits={}", "--set", "body.drag=0.0013 1/m", "--json"});
  const json straight = json::parse(without.output)["straight_travel_time_s"];
  REQUIRE(straight.is_number());
  CHECK(report["straight_travel_time_s"] == straight);
  const json& relaxations = report["search"]["relaxations"];
  REQUIRE(relaxations.size() >= 2);
  for (const json& relaxation : relaxations) {
    if (relaxation["limit"] != "smallest_valley_radius") continue;
    CHECK(relaxation["bound"].get<double>() == Approx(150.0));
    // What the report says would do is enough.
    const std::string radius = std::to_string(relaxation["needed"].get<double>() * 0.99) + "m";
    CHECK(solve(file, {"--set", "limits.smallest_valley_radius=" + radius, "--set", "limits.concave=false",
                       "--set", "body.drag=0.0013 1/m", "--set", "limits.lead_in=20m"})
              .exit_code == 0);
  }
}

/// @return the lowest exit speed that a message says to try; empty where it says none
std::string speed_to_try(const std::string& errors) {
  const std::string before = "exit_speed: {lowest: ";
  const std::size_t at = errors.find(before);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + before.size();
  return errors.substr(begin, errors.find('}', begin) - begin);
}

TEST_CASE("an exit speed that a message says to try is one that a track of the design reaches") {
  const std::string ends = "{start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}";
  const std::string deep = "{start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: {lowest: 1 m, highest: 2 m}}}";
  const std::string open = "{start: {x: 0 m, z: 5 m}, finish: {x: free, z: {lowest: 1 m}}}";
  struct Case {
    std::string track, body, objective;
  };
  for (const Case& one :
       {Case{ends, "friction_coefficient: 0.2, entry_speed: 1 m/s", "least_load"},
        Case{ends, "friction_coefficient: {low: 0.1, nominal: 0.2, high: 0.45}", "least_load"},
        Case{ends,
             "kind: rolling, radius: 8 mm, rolling_resistance: 0.02, "
             "groove_half_angle: 40 deg",
             "least_load"},
        Case{ends, "friction_coefficient: 0.1, drag: 0.3 1/m, entry_speed: 1 m/s", "least_load"},
        Case{ends, "friction_coefficient: 0.1, entry_speed: 30 m/s", "least_load"},
        Case{deep, "friction_coefficient: 0.2", "least_load"},
        Case{open, "friction_coefficient: 0.2", "least_length"},
        Case{open, "friction_coefficient: 0.2, entry_speed: 28 m/s", "least_drop"}}) {
    INFO(one.track << " " << one.body);
    const DesignFile file("glissade: 1\ntrack: " + one.track + "\nbody: {" + one.body +
                          "}\nlimits: {smallest_radius: 200 mm, objective: " + one.objective + "}\n");
    const Outcome refused = solve(file);
    CHECK(refused.exit_code == 2);
    const std::string speed = speed_to_try(refused.errors);
    INFO(refused.errors);
    REQUIRE_FALSE(speed.empty());
    // Whether limits can be met with it; that the fastest track tells at once.
    const Outcome tried =
        solve(file, {"--set", "limits.exit_speed.lowest=" + speed, "--set", "limits.objective=travel_time"});
    INFO(tried.errors);
    CHECK(tried.exit_code == 0);
  }
}

TEST_CASE("a message tells no exit speed to try where a body gains none on the way") {
  const DesignFile file(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 1 m}, finish: {x: 10 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0.2, entry_speed: 9 m/s}\nlimits: {objective: least_load}\n");
  const Outcome outcome = solve(file);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors, Contains("without a lowest exit_speed above the entry speed") &&
                                 Contains("Try: a track that falls further") && !Contains("{lowest:"));
}

TEST_CASE("a least drop between two points is told the design's own finish to set free") {
  const DesignFile file(
      "glissade: 1\ntrack: {start: {x: 1 m, z: 5 m}, finish: {x: -9.125 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0.2}\nlimits: {objective: least_drop}\n");
  const Outcome outcome = solve(file);
  CHECK_THAT(outcome.errors,
             Contains("with a drop that is given, 5 m") && Contains("Try: finish: {x: -9.125 m, z: free}"));
  CHECK(solve(file, {"--set", "track.finish={x: -9.125 m, z: free}"}).exit_code == 0);
  const Outcome level = solve(file, {"--set", "track.finish={x: free, z: 0 m}"});
  CHECK_THAT(level.errors,
             Contains("finish: {x: free, z: free}, with limits: {exit_speed: {lowest: 27 m/s}}"));
  CHECK(solve(file, {"--set", "track.finish={x: free, z: free}", "--set",
                     "limits.exit_speed.lowest=" + speed_to_try(level.errors)})
            .exit_code == 0);
}

TEST_CASE("a least load with a finish that is free both ways is told a level of the finish below the start") {
  const DesignFile file(
      "glissade: 1\ntrack: {start: {x: 1 m, z: 5 m}, finish: {x: free, z: free}}\n"
      "body: {friction_coefficient: 0.05}\nlimits: {objective: least_load, exit_speed: {lowest: 9 m/s}, "
      "smallest_radius: 1 m}\n");
  const Outcome outcome = solve(file);
  CHECK_THAT(outcome.errors, Contains("Try: a finish at a level: {x: free, z: -3.257 m}, or"));
  CHECK(solve(file, {"--set", "track.finish={x: free, z: -3.257 m}", "--set", "limits.objective=travel_time"})
            .exit_code == 0);
}

TEST_CASE("without friction no share of rubbing is told") {
  const DesignFile file(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0, entry_speed: 1 m/s}\n"
      "limits: {smallest_radius: 2 m, objective: least_wear}\n");
  const Outcome none = solve(file);
  CHECK(none.exit_code == 0);
  CHECK_THAT(none.output, Contains("s more than the fastest within these limits\n") && !Contains("nan") &&
                              !Contains("it rubs"));
  CHECK_THAT(solve(file, {"--set", "body.friction_coefficient=0.1"}).output, Contains("limits; it rubs "));
}

// What a search sets itself, such as that a body that hardly moves lies still, had a price here and no unit.
TEST_CASE("each active limit of a search is one that the design asks for, with the unit of its row") {
  const std::string creeping =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 0 m}, finish: {x: 12.2 m, z: free}}\n"
      "body: {friction_coefficient: {low: 0.2506, nominal: 0.358, high: 0.4296}, centre_height: 0.59 m, "
      "drag: 0.0145 1/m}\n"
      "limits: {slope_angle: {lowest: 0.305 rad, highest: 1.182 rad}, exit_speed: {lowest: 8.99 m/s}, "
      "smallest_valley_radius: 14.12 m, objective: least_drop}\n";
  // It would begin steeper than the feed falls, and vertical.
  const std::string fed =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 3 m, z: 0 m}}\n"
      "cross_section: {kind: u-channel, width: 600 mm, wall_height: 400 mm, thickness: 8 mm}\n"
      "stream: {mass_flow: 100 t/h, bulk_density: 1600 kg/m^3}\nbody: {friction_angle: 20 deg}\n"
      "feed: {kind: belt, belt_speed: 3.2 m/s, pulley_radius: 400 mm, drop: 150 mm}\n"
      "limits: {smallest_valley_radius: 1 m}\n";
  for (const std::string& text : {creeping, fed}) {
    const json told = json::parse(solve(DesignFile(text), {"--json"}).output);
    REQUIRE(told["search"]["status"] == "optimal");
    CHECK_FALSE(told["search"]["active"].empty());
    for (const json& active : told["search"]["active"]) {
      INFO(active.dump());
      const json& rows = told["limits"];
      const auto row = std::find_if(rows.begin(), rows.end(),
                                    [&](const json& one) { return one["limit"] == active["limit"]; });
      REQUIRE(row != rows.end());
      CHECK(active["unit"] == (*row)["unit"]);
      CHECK(active["price"] == (*row)["price"]);
    }
  }
}

TEST_CASE("a waypoint out of reach is named by itself, not by a distance below none") {
  const DesignFile file(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}\nbody: "
      "{friction_coefficient: 0.2}\n"
      "limits: {waypoints: [[5 m, 6 m]]}\n");
  const Outcome outcome = solve(file, {});
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("waypoints[0] and arrival at the finish cannot be met together") &&
                                 !Contains("waypoints[0] 0 m") && !Contains("waypoints[0] -") &&
                                 !Contains("waypoints[0]: -"));
}

TEST_CASE("a mirrored track has the same time, prices and places as its image") {
  const std::string right =
      "glissade: 1\n"
      "track: {start: {x: 2 m, z: 4 m}, finish: {x: 7.4 m, z: {lowest: 1.6 m, highest: 1.9 m}}}\n"
      "body: {friction_angle: {low: 14 deg, nominal: 17 deg, high: 20 deg}}\n"
      "limits:\n"
      "  speed: {highest: 4 m/s}\n"
      "  keep_outs:\n"
      "    - {outline: [[4 m, 3 m], [4.3 m, 3 m], [4.3 m, 3.4 m], [4 m, 3.4 m]], clearance: 300 mm, pass: "
      "below}\n"
      "  stay_above: [{line: [[2 m, 1 m], [8 m, 0 m]], clearance: 500 mm}]\n"
      "  half_planes: [{line: [[8 m, 0 m], [8 m, 1 m]], stay: left}]\n";
  const std::string left =
      "glissade: 1\n"
      "track: {start: {x: -2 m, z: 4 m}, finish: {x: -7.4 m, z: {lowest: 1.6 m, highest: 1.9 m}}}\n"
      "body: {friction_angle: {low: 14 deg, nominal: 17 deg, high: 20 deg}}\n"
      "limits:\n"
      "  speed: {highest: 4 m/s}\n"
      "  keep_outs:\n"
      "    - {outline: [[-4 m, 3 m], [-4.3 m, 3 m], [-4.3 m, 3.4 m], [-4 m, 3.4 m]], clearance: 300 mm, "
      "pass: below}\n"
      "  stay_above: [{line: [[-8 m, 0 m], [-2 m, 1 m]], clearance: 500 mm}]\n"
      "  half_planes: [{line: [[-8 m, 0 m], [-8 m, 1 m]], stay: right}]\n";
  const json one = solved(DesignFile(right));
  const json other = solved(DesignFile(left));
  CHECK(other["travel_time_s"].get<double>() == Approx(one["travel_time_s"].get<double>()).epsilon(1e-9));
  CHECK(check_of(one, "finish.z.lowest")["bound"].get<double>() == Approx(1.6));
  CHECK(check_of(one, "finish.z.lowest")["side"] == "at least");
  CHECK(check_of(one, "speed.highest")["reached"].get<double>() == Approx(4.0).epsilon(1e-4));
  CHECK(one["search"]["active"].size() == other["search"]["active"].size());
}

TEST_CASE("the finish anywhere on a level is named by the design's x") {
  const DesignFile file(
      "glissade: 1\n"
      "track: {start: {x: 1 m, z: 4 m}, finish: {x: {lowest: -9 m, highest: -5 m}, z: 1 m}}\n"
      "body: {friction_angle: 10 deg}\n"
      "limits: {slope_angle: {highest: 40 deg}}\n");
  const json track = solved(file);
  CHECK(track["run_m"].get<double>() == Approx(6.0).epsilon(1e-6));
  const json nearest = check_of(track, "finish.x.highest");
  CHECK(nearest["bound"].get<double>() == Approx(-5.0));
  CHECK(nearest["reached"].get<double>() == Approx(-5.0));
  CHECK(nearest["side"] == "at most");
}

TEST_CASE("a search that runs out of time says so, with exit code 4") {
  // Lines and a bend keep every limit of the in-run, ...
  const DesignFile simple(kInrun);
  const Outcome bend = solve(simple, {"--time-budget", "0.01ms"});
  CHECK(bend.exit_code == 4);
  CHECK_THAT(bend.errors,
             Contains("the time budget ran out before a search came to a track: one of lines and a bend"));
  CHECK_THAT(bend.output, Contains("feasible, not converged"));
  // ... but pass no point beside them.
  std::string design = kInrun;
  design.insert(design.find("  concave: true"), "  waypoints: [[40 m, 21 m]]\n");
  const DesignFile file(design);
  const Outcome outcome = solve(file, {"--time-budget", "0.01ms"});
  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.errors, Contains("design.yaml:5:1: ended early, before any track kept every limit") &&
                                 Contains("--time-budget"));
  // For programs: all keys of a track, as where the limits contradict each other.
  const Outcome told = solve(file, {"--time-budget", "0.01ms", "--json"});
  CHECK(told.exit_code == 4);
  const json none = json::parse(told.output);
  CHECK(none["status"] == "no track found");
  CHECK(none["travel_time_s"].is_null());
  CHECK(none["search"]["status"] == "no track found");
  const json track = solved(simple);
  for (const auto& [key, value] : track.items()) CHECK(none.contains(key));
  CHECK(solve(file, {"--time-budget", "-1s"}).exit_code == 2);
  // So do searches that are made of searches.
  const std::string hill = shipped("hills/garmisch_hs142");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"solve", shipped("ore_transfer")},
                                             {"compare", shipped("ore_transfer")},
                                             {"redesign", hill},
                                             {"redesign", hill, "--for", "least-load"}}) {
    std::vector<std::string> briefly = arguments;
    briefly.insert(briefly.end(), {"--time-budget", "1ms"});
    const Outcome early = glissade_run(briefly);
    INFO(arguments[0] << "\n" << early.errors);
    CHECK(early.exit_code == 4);
    CHECK_THAT(early.errors, Contains("ended early: ") && Contains("Try: a larger --time-budget"));
    CHECK_FALSE(early.output.empty());
  }
  // Commands that draw or judge what the search found say so, too, once they have done it.
  const TempDir place;
  const auto asked = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--time-budget", "0.01ms"});
    const Outcome of_track = glissade_run(arguments, {place.path(), {}, {}});
    CAPTURE(arguments.front(), of_track.output);
    CHECK(of_track.exit_code == 4);
    CHECK_THAT(of_track.errors, Contains("ended early: ") && Contains("a larger --time-budget"));
  };
  asked({"plot", simple.path(), "-o", "p.svg"});
  CHECK(std::filesystem::file_size(place / "p.svg") > 1000);
  asked({"profile", simple.path(), "-d", "sheets"});
  CHECK(std::filesystem::exists(place / "sheets"));
  asked({"compare", simple.path()});
  asked({"ride", simple.path(), "--friction-coefficient", "0.02"});
  const Outcome unit = solve(file, {"--time-budget", "10deg"});
  CHECK(unit.exit_code == 2);
  CHECK_THAT(unit.errors, Contains("--time-budget: 10deg is an angle, not a time"));
}

TEST_CASE("the shipped designs with limits are solved to the optimum") {
  for (const char* name : {"ski_jump_inrun_with_limits", "grain_chute_with_limits", "toboggan_on_terrain"}) {
    INFO(name);
    const Outcome outcome = glissade_run({"solve", shipped(name), "--json"});
    INFO(outcome.errors);
    REQUIRE(outcome.exit_code == 0);
    const json track = json::parse(outcome.output);
    CHECK(track["search"]["status"] == "optimal");
    CHECK(track["search"]["active"].size() >= 3);
    for (const json& check : track["limits"]) CHECK(check["kept"] == true);
  }
}

namespace {

/// A channel whose floor keeps clear of a beam by itself while its walls run through it.
constexpr const char* kPastBeam =
    "glissade: 1\n"
    "name: U-channel past a beam\n"
    "track: {start: {x: 0 m, z: 6.2 m}, finish: {x: 5.4 m, z: 1.1 m}}\n"
    "body: {friction_angle: 17 deg}\n"
    "limits:\n"
    "  keep_outs:\n"
    "    - {outline: [[1.2 m, 5 m], [1.6 m, 5 m], [1.6 m, 5.5 m], [1.2 m, 5.5 m]], clearance: 100 mm}\n"
    "cross_section: {kind: u-channel, width: 400 mm, wall_height: 600 mm, thickness: 4 mm}\n"
    "mesh: {tolerance: 2 mm}\n"
    "export: [stl]\n";

}  // namespace

TEST_CASE("walls keep clear of a beam that the floor passes by far") {
  const DesignFile file(kPastBeam);
  const json solid = solved(file);
  CHECK(solid["clearances_from"] == "solid");
  CHECK(solid["search"]["status"] == "optimal");
  const json check = check_of(solid, "keep_outs[0]");
  CHECK(check["kept"] == true);
  CHECK(check["reached"].get<double>() == Approx(0.1).epsilon(1e-4));
  CHECK(check["closest"]["part"] == "rim");
  CHECK(check["closest"]["height_m"].get<double>() == Approx(0.6));

  const json floor = solved(file, {"--set", "limits.clearances_from=centerline"});
  CHECK(floor["clearances_from"] == "centerline");
  CHECK(floor["travel_time_s"].get<double>() < solid["travel_time_s"].get<double>());
  CHECK(check_of(floor, "keep_outs[0]")["closest"].is_null());
  CHECK(check_of(floor, "keep_outs[0]")["reached"].get<double>() > 0.5);
}

TEST_CASE("a track whose walls run through a beam is not called kept, whatever its kind") {
  const DesignFile file(kPastBeam);
  for (const char* kind : {"straight", "cycloid", "constant-speed", "no-curvature-load"}) {
    const Outcome outcome =
        solve(file, {"--set", std::string("centerline.kind=") + kind, "--set",
                     "limits.keep_outs.0.outline=[[1.2 m, 4.3 m], [1.6 m, 4.3 m], [1.6 m, "
                     "5.5 m], [1.2 m, 5.5 m]]"});
    INFO(kind << ": " << outcome.output << outcome.errors);
    CHECK(outcome.exit_code == 3);
    CHECK_THAT(outcome.errors,
               Contains("keep_outs[0] 100 mm is broken by") && Contains("reaches in by") && Contains(", x "));
  }
}

TEST_CASE("headroom counts where it is higher than the walls, and without a section too") {
  const DesignFile file(kPastBeam);
  const json high = solved(file, {"--set", "limits.headroom=700mm"});
  CHECK(check_of(high, "keep_outs[0]")["closest"]["part"] == "headroom");
  const json low = solved(file, {"--set", "limits.headroom=200mm"});
  CHECK(check_of(low, "keep_outs[0]")["closest"]["part"] == "rim");
  const Outcome unused = solve(file, {"--set", "limits={headroom: 200 mm}"});
  CHECK(unused.exit_code == 2);
  CHECK_THAT(unused.errors, Contains("headroom: 200 mm is kept clear of nothing"));
  const Outcome contradiction =
      solve(file, {"--set", "limits.headroom=200mm", "--set", "limits.clearances_from=centerline"});
  CHECK(contradiction.exit_code == 2);
  CHECK_THAT(contradiction.errors, Contains("headroom: 200 mm contradicts clearances_from: centerline"));
}

TEST_CASE("the summary says what clearances are measured from") {
  const DesignFile file(kPastBeam);
  // Higher than the start, the beam shapes no track: there is little to search.
  const std::string higher =
      "limits.keep_outs.0.outline=[[1.2 m, 7 m], [1.6 m, 7 m], [1.6 m, 7.5 m], [1.2 m, 7.5 m]]";
  CHECK_THAT(solve(file, {"--set", higher}).output,
             Contains("from the whole solid, 4 mm below to 600 mm above the floor"));
  CHECK_THAT(solve(file, {"--set", higher, "--set", "limits.clearances_from=centerline"}).output,
             Contains("from the centerline"));
}

TEST_CASE("leads that are longer than what is left are named, with a length that does") {
  const std::string text =
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 6 m}, finish: {x: 10 m, z: 0 m}}\n"
      "body: {friction_angle: 11 deg}\n"
      "centerline: {kind: fastest}\n";
  const Outcome in = solve(DesignFile(text + "limits: {lead_in: 12 m}\n"));
  CHECK(in.exit_code == 4);
  CHECK_THAT(in.errors,
             Contains("no track was found with lead_in 12 m, which is no shorter than the straight "
                      "line from start to finish, 11.66 m") &&
                 Contains("falls 6.63 m or more within lead_in, at least 633 mm below the finish") &&
                 Contains("there may be a track") && Contains("Try: lead_in: 11.5 m") &&
                 !Contains("wider limits"));
  CHECK(solve(DesignFile(text + "limits: {lead_in: 11.5 m}\n")).exit_code == 0);
  // Down, round, and up again a body of little friction may arrive: nothing says that the limits contradict each other.
  const Outcome out = solve(DesignFile(text + "limits: {lead_out: 15 m}\n"));
  CHECK(out.exit_code == 4);
  CHECK_THAT(out.errors, Contains("no track was found with lead_out 15 m") &&
                             Contains("begins its lead_out 11.2 m or more below the finish") &&
                             Contains("Try: lead_out: 11.5 m") && !Contains("lowest_normal_load"));
  CHECK(solve(DesignFile(text + "limits: {lead_out: 11.5 m}\n")).exit_code == 0);
}

TEST_CASE("a finish without room for the section is said at once, with what would do") {
  const DesignFile file(kPastBeam);
  // A ceiling 0.4 m above the finish: walls of 0.6 m do not fit under it, whatever the slope there.
  const std::vector<std::string> low = {
      "--set",
      "limits={exit_slope_angle: {lowest: 0 deg, highest: 30 deg}, stay_below: [{line: [[3 m, 1.5 m], [7 m, "
      "1.5 m]], clearance: 50 mm}]}"};
  const Outcome outcome = solve(file, low);
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("the finish lies too close to stay_below[0] for the solid") &&
                                 Contains("reaches 4 mm below and 600 mm above the floor") &&
                                 Contains("no direction of the track there keeps the clearance"));
  std::vector<std::string> lower = low;
  lower.insert(lower.end(), {"--set", "cross_section.wall_height=200mm"});
  CHECK(solve(file, lower).exit_code == 0);
  // Upright to the ceiling walls may be higher.
  const Outcome before =
      solve(file, {"--set",
                   "limits={entry_slope_angle: 10 deg, keep_outs: [{outline: [[-1 m, 6.4 m], [1 m, 6.4 m], "
                   "[1 m, 6.6 m], [-1 m, 6.6 m]], clearance: 50 mm}]}"});
  CHECK(before.exit_code == 3);
  CHECK_THAT(before.errors, Contains("the start lies too close to keep_outs[0]") &&
                                Contains("a solid and headroom that reach at most"));
}

TEST_CASE(
    "an end on the side of a keep-out that is not to be passed is said, whatever clearances are measured "
    "from") {
  const DesignFile file(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 7 m, z: 0 m}}\nbody: {friction_coefficient: "
      "0.2}\n"
      "limits: {keep_outs: [{outline: [[6.5 m, -3 m], [7.5 m, -3 m], [7.5 m, -2 m], [6.5 m, -2 m]], pass: "
      "below}]}\n"
      "cross_section: {kind: slab, width: 1 m, thickness: 50 mm}\n");
  for (const char* from : {"solid", "centerline"}) {
    CAPTURE(from);
    const Outcome outcome = solve(file, {"--set", std::string("limits.clearances_from=") + from});
    CHECK(outcome.exit_code == 3);
    CHECK_THAT(outcome.errors, Contains("the finish lies above keep_outs[0], which is to be passed below"));
  }
  CHECK(solve(file, {"--set", "limits.keep_outs.0.pass=either"}).exit_code == 0);
}

}  // namespace limits_test
