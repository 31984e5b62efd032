#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/design/design.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <cmath>
#include <numbers>
#include <string>

using namespace glissade;
using namespace glissade::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

constexpr double kDegree = 0.017453292519943295;

std::string with_limits(const std::string& limits) {
  return sound_design_with("mesh:", "limits: {" + limits + "}\nmesh:");
}

Design limited(const std::string& limits) {
  return parse_design(with_limits(limits), "d.yaml");
}

std::string problems_of_limits(const std::string& limits) {
  return problems_of(with_limits(limits));
}

}  // namespace

TEST_CASE("the limits of a ski in-run read as its file says") {
  const Design design = parse_design(R"(glissade: 1
track: {start: {x: 0 m, z: 47.08 m}, finish: {x: 90.23 m, z: 0 m}}
body: {friction_coefficient: 0.03, drag: 0.0013 1/m}
limits:
  slope_angle: {highest: 35 deg}
  exit_slope_angle: 11 deg
  lead_in: 20 m
  lead_out: 6.9 m
  highest_curvature_load: 7.14 m/s^2
  smallest_radius: 90 m
  highest_curvature_rate: 0.01 1/m^2
  concave: true
)",
                                     "inrun.yaml");
  REQUIRE(design.limits);
  const Limits& limits = *design.limits;
  CHECK(limits.slope_angle == Range{{}, 35 * kDegree});
  CHECK(limits.exit_slope_angle == Range{11 * kDegree, 11 * kDegree});
  CHECK_FALSE(limits.entry_slope_angle.limited());
  CHECK(limits.lead_in == 20.0);
  CHECK(limits.lead_out == 6.9);
  CHECK(limits.highest_curvature_load == 7.14);
  CHECK(limits.smallest_valley_radius == 90.0);
  CHECK(limits.smallest_crest_radius == 90.0);
  CHECK(limits.highest_curvature_rate == 0.01);
  CHECK(limits.concave);
  CHECK(limits.lowest_normal_load == 0.0);
  CHECK_FALSE(limits.highest_normal_load.has_value());
  CHECK(design.objective.kind == ObjectiveKind::travel_time);
  CHECK(design.where("limits.exit_slope_angle") == "inrun.yaml:6:21");
}

TEST_CASE("loads, speeds, lengths and the objective of limits read in SI units") {
  const Design design = limited(
      "highest_normal_load: 2.5 g, lowest_normal_load: 0.1 g, smallest_valley_radius: 3 m, "
      "speed: {lowest: 1 m/s, highest: 36 km/h, lowest_from: 50 cm}, exit_speed: {highest: 4 m/s}, "
      "arc_length: {lowest: 8 m, highest: 9 m}, objective: {kind: blend, exit_speed_weight: 0.1 "
      "s/(m/s)}");
  const Limits& limits = *design.limits;
  CHECK(limits.highest_normal_load == 2.5 * 9.80665);
  CHECK(*limits.lowest_normal_load == Approx(0.980665).epsilon(1e-15));
  CHECK(limits.smallest_valley_radius == 3.0);
  CHECK_FALSE(limits.smallest_crest_radius.has_value());
  CHECK(limits.speed == Range{1.0, 10.0});
  CHECK(limits.lowest_speed_from == 0.5);
  CHECK(limits.exit_speed == Range{{}, 4.0});
  CHECK(limits.arc_length == Range{8.0, 9.0});
  CHECK(design.objective.kind == ObjectiveKind::blend);
  CHECK(design.objective.exit_speed_weight == 0.1);
}

TEST_CASE("a lowest normal load of none holds the body from both sides") {
  CHECK_FALSE(limited("lowest_normal_load: none").limits->lowest_normal_load.has_value());
  CHECK(limited("objective: exit_speed").objective.kind == ObjectiveKind::exit_speed);
}

TEST_CASE("clearances read in the coordinates of the design") {
  const Limits limits =
      *limited(
           "half_planes: [{line: [[0 m, 7 m], [1 m, 7 m]], stay: below, clearance: 10 cm}, "
           "{line: [[6 m, 0 m], [6 m, 1 m]], stay: left}], "
           "keep_outs: [{outline: [[2 m, 5 m], [2.4 m, 5 m], [2.4 m, 5.4 m], [2 m, 5.4 m]], pass: below}], "
           "stay_above: [{line: [[0 m, 1 m], [6 m, 0 m]], clearance: 200 mm}], "
           "stay_below: [{line: [[0 m, 8 m], [6 m, 6 m]]}], waypoints: [[2 m, 3 m]]")
           .limits;
  REQUIRE(limits.half_planes.size() == 2);
  CHECK(limits.half_planes[0].point == Vec2{0.0, 7.0});
  CHECK(limits.half_planes[0].forbidden == Vec2{0.0, 1.0});
  CHECK(limits.half_planes[0].clearance == 0.1);
  CHECK(limits.half_planes[1].forbidden == Vec2{1.0, 0.0});
  REQUIRE(limits.keep_outs.size() == 1);
  CHECK(limits.keep_outs[0].outline.size() == 4);
  CHECK(limits.keep_outs[0].passage == Passage::below);
  REQUIRE(limits.stay_above.size() == 1);
  CHECK(limits.stay_above[0].clearance == 0.2);
  CHECK(limits.stay_below.at(0).line == std::vector{Vec2{0.0, 8.0}, Vec2{6.0, 6.0}});
  CHECK(limits.waypoints == std::vector{Vec2{2.0, 3.0}});
}

TEST_CASE("a point of the limits has its run and drop in the plane of the track") {
  TrackDesign track;
  track.start = {1.0, 0.0, 6.0};
  track.finish = {5.0, 0.0, 1.0};
  CHECK(in_track_plane(track, {3.0, 2.0}) == Vec2{2.0, 4.0});
  track.finish.x = -5.0;
  CHECK(in_track_plane(track, {-3.0, 2.0}) == Vec2{4.0, 4.0});
  // Not along x: the first coordinate is already the distance from the start.
  track.finish = {4.0, 4.0, 1.0};
  CHECK(in_track_plane(track, {3.0, 2.0}) == Vec2{3.0, 4.0});
}

TEST_CASE("friction as a range has a low, a nominal and a high value, for limits to hold at") {
  std::string text = sound_design_with("17 deg", "{low: 14 deg, nominal: 17 deg, high: 20 deg}");
  CHECK(problems_of(text).empty());
  text.insert(text.find("mesh:"),
              "limits: {speed: {highest: 4 m/s}, objective: {kind: travel_time, worst_case: true}}\n");
  const Design design = parse_design(text, "d.yaml");
  CHECK(design.body.low_friction == Friction::from_angle(Angle::from_degrees(14)));
  CHECK(design.body.friction == Friction::from_angle(Angle::from_degrees(17)));
  CHECK(design.body.high_friction == Friction::from_angle(Angle::from_degrees(20)));
  CHECK(design.objective.worst_case);
  // It is the high value that must arrive.
  text.replace(text.find("20 deg"), 6, "48 deg");
  CHECK_THAT(problems_of(text), StartsWith("infeasible: d.yaml:7:3: friction_angle: 48 deg is steeper"));
  text.replace(text.find("14 deg"), 6, "18 deg");
  CHECK_THAT(problems_of(text), Contains("low, nominal and high are not in ascending order"));
}

TEST_CASE("the finish may lie anywhere on a vertical line or on a level, within bounds or free") {
  const auto finish = [](const std::string& text) {
    return parse_design(sound_design_with("{x: 5.4 m, z: 1.1 m}", text), "d.yaml").track;
  };
  const TrackDesign line = finish("{x: 5.4 m, z: free}");
  CHECK(line.free_finish == FinishKind::vertical_line);
  CHECK_FALSE(line.free_range.limited());
  CHECK(line.finish.x == 5.4);
  const TrackDesign bounded = finish("{x: 5.4 m, z: {lowest: 1 m, highest: 2 m}}");
  CHECK(bounded.free_range == Range{1.0, 2.0});
  CHECK(bounded.finish.z == 1.0);
  const TrackDesign level = finish("{x: {lowest: 4 m, highest: 6 m}, z: 1.1 m}");
  CHECK(level.free_finish == FinishKind::level);
  CHECK(level.free_range == Range{4.0, 6.0});
  CHECK(finish("{x: free, z: 1.1 m}").finish.x > 0.0);

  CHECK_THAT(problems_with("{x: 5.4 m, z: 1.1 m}", "{x: free, z: free}"),
             Contains("the finish is free both ways"));
  CHECK_THAT(problems_with("{x: 5.4 m, z: 1.1 m}", "{x: 5.4 m, z: {lowest: 2 m, highest: 1 m}}"),
             Contains("z: lowest 2 m is above highest 1 m"));
  CHECK_THAT(problems_with("{x: 5.4 m, z: 1.1 m}", "{x: 5.4 m, z: {lowest: 5 m}}"),
             StartsWith("infeasible: d.yaml:7:19: friction_angle: 17 deg is steeper than the mean slope"));
  CHECK_THAT(problems_with("{x: 5.4 m, z: 1.1 m}", "{x: 0 m, z: free}"),
             Contains("the finish lies on the vertical through the start"));
}

TEST_CASE("a track to an edge has a start that is free both ways, or one way") {
  constexpr std::string_view kEnds = "start: {x: 0 m, z: 6.2 m}\n  finish: {x: 5.4 m, z: 1.1 m}\n";
  const auto design = [&](const std::string& ends, const std::string& limits) {
    std::string text = sound_design_with(kEnds, ends + "\n");
    return text.insert(text.find("cross_section:"), limits.empty() ? "" : "limits: {" + limits + "}\n");
  };
  const std::string speed = "exit_speed: {lowest: 9 m/s}";
  const auto track = [&](const std::string& ends) {
    return parse_design(design(ends, speed), "d.yaml").track;
  };
  const TrackDesign both = track("edge: {x: 7 m, z: 1 m}");
  CHECK(both.free_start);
  CHECK(both.free_finish == FinishKind::anywhere);
  CHECK(both.finish == Vec3{7.0, 0.0, 1.0});
  CHECK(both.start.x < 7.0);
  CHECK(both.start.z > 1.0);
  CHECK(track("edge: {x: 7 m, z: 1 m}\n  start: {x: free, z: free}") == both);
  CHECK(track("edge: {x: 7 m, z: 1 m}\n  start: {x: free, z: 4 m}").free_finish == FinishKind::level);
  CHECK(track("edge: {x: 7 m, z: 1 m}\n  start: {x: 2 m, z: free}").free_finish == FinishKind::vertical_line);
  CHECK_FALSE(track("edge: {x: 7 m, z: 1 m}\n  start: {x: 2 m, z: 4 m}").free_start);

  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}", "")),
             Contains("the start is free both ways, and no exit speed above the entry speed is asked for"));
  CHECK(parse_design(design("edge: {x: 7 m, z: 1 m}", speed + ", waypoints: [[3 m, 3 m]]"), "d.yaml")
            .limits->waypoints.size() == 1);
  // As start and finish are written.
  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}",
                                speed + ", waypoints: [{x: 3 m, z: 4 m}, {z: 2 m, x: 5 m}]")),
             Contains("waypoints[0] is a group of keys, not a list") && Contains("[3 m, 4 m]") &&
                 Contains("[5 m, 2 m]"));
  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}", speed + ", waypoints: [[8 m, 3 m]]")),
             Contains("waypoints[0] lies 1 m past the edge"));
  CHECK_THAT(problems_of(design(
                 "edge: {x: 7 m, z: 1 m}",
                 speed + ", keep_outs: [{outline: [[6 m, 0 m], [8 m, 0 m], [8 m, 2 m], [6 m, 2 m]]}]")),
             Contains("the edge lies in keep_outs[0]"));
  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}\n  finish: {x: 7 m, z: 1 m}", speed)),
             Contains("edge alone, which is where the track ends"));
  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}\n  start: {x: 7 m, z: free}", speed)),
             Contains("the start lies on the vertical through the edge"));
  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}", speed + ", objective: least_peak_wear")),
             Contains("objective: least_peak_wear, of a body that is no stream") &&
                 Contains("What rubs on the floor follows from a mass flow."));
  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}", speed + ", objective: least_load")),
             Contains("objective: least_load, with an end that is free both ways"));
  CHECK_THAT(
      problems_of(design("edge: {x: 7 m, z: 1 m}\n  start: {x: free, z: 4 m}", "objective: least_drop")),
      Contains("objective: least_drop, with a drop that is given, 3 m") &&
          Contains("It is the least height between start and finish.") && Contains("z: free"));
  CHECK_THAT(problems_of(design("start: {x: 0 m, z: 6.2 m}\n  finish: {x: 5.4 m, z: 1.1 m}",
                                "objective: least_drop")),
             Contains("objective: least_drop, with a drop that is given, 5.1 m"));
  CHECK_THAT(problems_of(design("edge: {x: 7 m, z: 1 m}\n  start: {x: free, z: 4 m}",
                                "objective: least_curvature_rate")),
             Contains("objective: least_curvature_rate, without a lowest exit_speed"));
}

TEST_CASE("a finish that is free both ways lies within its bounds, and leads the way they lie") {
  const auto finish = [](const std::string& text) {
    std::string whole = sound_design_with("{x: 5.4 m, z: 1.1 m}", text);
    whole.insert(whole.find("cross_section:"), "limits: {exit_speed: {lowest: 9 m/s}}\n");
    return parse_design(whole, "d.yaml").track;
  };
  const TrackDesign open = finish("{x: free, z: free}");
  CHECK(open.free_finish == FinishKind::anywhere);
  CHECK_FALSE(open.free_start);
  const TrackDesign bounded = finish("{x: {highest: -2 m}, z: {lowest: 0 m, highest: 3 m}}");
  CHECK(bounded.free_range == Range{std::nullopt, -2.0});
  CHECK(bounded.free_height == Range{0.0, 3.0});
  CHECK(bounded.finish.x <= -2.0);
  CHECK(bounded.finish.z <= 3.0);
  // Bounds that keep it away from the start, at (0, 6.2) m, say how far it is; others leave that to a speed.
  for (const char* const away : {"{x: {lowest: 2 m}, z: free}", "{x: {highest: -2 m}, z: {highest: 7 m}}",
                                 "{x: free, z: {highest: 3 m}}"})
    CHECK(problems_with("{x: 5.4 m, z: 1.1 m}", away).empty());
  CHECK_THAT(problems_with("{x: 5.4 m, z: 1.1 m}", "{x: {lowest: -2 m}, z: {highest: 7 m}}"),
             Contains("the finish is free both ways, and no exit speed above the entry speed is asked for"));
}

TEST_CASE("limits that contradict each other or the design are refused where they stand") {
  CHECK_THAT(problems_of_limits("exit_slope_angle: 40 deg, slope_angle: {highest: 35 deg}"),
             StartsWith("d.yaml:10:28: exit_slope_angle: 40 deg contradicts slope_angle: at most 35 deg"));
  CHECK_THAT(problems_of_limits("slope_angle: {lowest: 40 deg, highest: 35 deg}"),
             Contains("slope_angle: lowest 40 deg is above highest 35 deg"));
  CHECK_THAT(
      problems_of_limits("entry_slope_angle: 10 deg, exit_slope_angle: 20 deg, concave: true"),
      Contains(
          "concave: the track would have to be steeper at the exit (20 deg) than at the entry (10 deg)"));
  CHECK_THAT(problems_of_limits("highest_normal_load: 5 m/s^2, lowest_normal_load: 1 g"),
             Contains("lowest_normal_load: 9.807 m/s^2 is above highest_normal_load: 5 m/s^2"));
  CHECK_THAT(problems_of_limits("arc_length: {highest: 7 m}"),
             Contains("arc_length: at most 7 m is shorter than the straight line, 7.428 m"));
  CHECK_THAT(problems_of_limits("arc_length: {highest: 8 m}, lead_in: 5 m, lead_out: 4 m"),
             Contains("leaves no room for lead_in and lead_out, 9 m"));
  CHECK_THAT(
      problems_of_limits("speed: {lowest: 1 m/s}"),
      Contains("speed.lowest: 1 m/s is above the entry speed, 0 m/s") && Contains("Try: lowest_from: 0.5 m"));
}

TEST_CASE("single limits are refused out of their bounds, with a wrong unit, or ambiguous") {
  CHECK_THAT(problems_of_limits("smallest_radius: 0 m"),
             StartsWith("d.yaml:10:27: smallest_radius: 0 mm is not positive") &&
                 Contains("Try: no smallest_radius"));
  CHECK_THAT(problems_of_limits("exit_slope_angle: {highest: 100 deg}"),
             StartsWith("d.yaml:10:38: exit_slope_angle.highest: 100 deg is out of range") &&
                 Contains("It lies between -90 deg and 90 deg.") && Contains("Try: at most 90 deg"));
  CHECK_THAT(problems_of_limits("lowest_normal_load: -1 m/s^2"),
             Contains("lowest_normal_load: -1 m/s^2 is out of range"));
  CHECK_THAT(problems_of_limits("speed: {highest: 0 m/s}"), Contains("speed.highest: 0 m/s is not positive"));
  CHECK_THAT(
      problems_of_limits("slope_angle: 35 deg"),
      StartsWith("d.yaml:10:23: slope_angle: 35 deg does not say whether it is the lowest or the highest") &&
          Contains("Try: slope_angle: {highest: 35 deg}"));
  CHECK_THAT(problems_of_limits("highest_normal_load: 3 m"),
             Contains("3 m is a length, not an acceleration"));
  CHECK_THAT(problems_of_limits("concave: yes"), Contains("concave: yes is neither true nor false"));
  CHECK_THAT(problems_of_limits("smalest_radius: 3 m"),
             Contains("unknown key smalest_radius") && Contains("Try: smallest_radius"));
  CHECK_THAT(problems_of_limits("objective: blend"), Contains("objective: blend has no weight"));
  CHECK_THAT(problems_of_limits("objective: {kind: travel_time, worst_case: true}"),
             Contains("worst_case: the friction has no highest value"));
  CHECK_THAT(problems_of_limits("lead_in: -1 m"), Contains("lead_in: -1 m is out of range"));
  CHECK_THAT(problems_of_limits("exit_speed: -1 m/s"), Contains("exit_speed: -1 m/s is out of range"));
}

TEST_CASE("a start, finish or waypoint that breaks a clearance is told") {
  CHECK_THAT(problems_of_limits("stay_above: [{line: [[0 m, 1 m], [6 m, 1 m]], clearance: 200 mm}]"),
             Contains("the finish lies 100 mm within the clearance of stay_above[0], 200 mm"));
  CHECK_THAT(problems_of_limits("stay_above: [{line: [[0 m, 2 m], [6 m, 2 m]], clearance: 200 mm}]"),
             Contains("the finish lies 900 mm on the wrong side of stay_above[0]"));
  CHECK_THAT(problems_of_limits("half_planes: [{line: [[0 m, 6 m], [1 m, 6 m]], stay: below}]"),
             Contains("the start lies 200 mm on the wrong side of half_planes[0]"));
  CHECK_THAT(problems_of_limits(
                 "keep_outs: [{outline: [[1 m, 2 m], [3 m, 2 m], [3 m, 4 m]]}], waypoints: [[2.5 m, 3 m]]"),
             Contains("waypoints[0] lies in keep_outs[0]"));
}

TEST_CASE("waypoints out of their order are told each at its place, all at once") {
  const std::string waypoints = "waypoints: [[3 m, 3 m], [1 m, 4 m], [500 mm, 5 m]]";
  const std::string problems = problems_of_limits(waypoints);
  CHECK_THAT(problems, Contains("waypoints[1] lies 2 m along the run before waypoints[0]") &&
                           Contains("waypoints[2] lies 500 mm along the run before waypoints[1]"));
  CHECK(problems_of_limits("waypoints: [[1 m, 4 m], [1 m, 3.9 m], [3 m, 3 m]]").empty());
}

TEST_CASE("shapes of clearances are sound") {
  CHECK_THAT(problems_of_limits("keep_outs: [{outline: [[1 m, 2 m], [3 m, 2 m]]}]"),
             Contains("outline: 2 corners"));
  CHECK_THAT(problems_of_limits("stay_above: [{line: [[1 m, 2 m], [1 m, 3 m]]}]"),
             Contains("line[1]: x does not grow from 1 m to 1 m"));
  CHECK_THAT(problems_of_limits("stay_below: [{line: [[1 m, 2 m]]}]"), Contains("line: 1 point\n"));
  CHECK_THAT(problems_of_limits("half_planes: [{line: [[1 m, 2 m], [3 m, 2 m]], stay: left}]"),
             Contains("stay: left is no side of this line"));
  const std::string one_point =
      problems_of_limits("half_planes: [{line: [[1 m, 2 m], [1 m, 2 m]], stay: above}]");
  CHECK_THAT(one_point, Contains("line: its two points are one") && !Contains("no side"));
  CHECK_THAT(problems_of_limits("half_planes: [{line: [[1 m, 2 m], [3 m, 2 m], [4 m, 2 m]], stay: above}]"),
             Contains("line: 3 points instead of 2"));
  CHECK_THAT(
      problems_of_limits("keep_outs: [{outline: [[1 m, 2 m], [3 m, 2 m], [2 m, 3 m]], clearance: -1 m}]"),
      Contains("clearance: -1 m is out of range"));
}

TEST_CASE("a line of ground comes from a CSV file beside the design, its faults with the file's lines") {
  const TempDir place;
  const auto read = [&](const std::string& csv, const std::string& keys) {
    put_bytes(place / "ground.csv", csv);
    put_bytes(place / "d.yaml",
              std::string(kSoundDesign) + "limits: {stay_above: [{file: ground.csv" + keys + "}]}\n");
    return read_design(place / "d.yaml");
  };
  const auto refusal = [&](const std::string& csv, const std::string& keys) -> std::string {
    try {
      static_cast<void>(read(csv, keys));
      return {};
    } catch (const Error& error) {
      return error.what();
    }
  };
  const Design design = read("x,z\n0,0.5\n2.5,0.25\n6,0\n", ", clearance: 100 mm");
  REQUIRE(design.limits->stay_above.size() == 1);
  CHECK(design.limits->stay_above[0].line == std::vector<Vec2>{{0.0, 0.5}, {2.5, 0.25}, {6.0, 0.0}});
  CHECK(design.limits->stay_above[0].clearance == 0.1);
  CHECK(read("s;h\n0;500\n6000;0\n", ", columns: [s, h], unit: mm").limits->stay_above[0].line ==
        std::vector<Vec2>{{0.0, 0.5}, {6.0, 0.0}});
  CHECK_THAT(refusal("x,z\n0,0\n3,0\n2,0\n", ""),
             Contains("file: ground.csv:4: x does not grow from 3 m to 2 m"));
  CHECK_THAT(refusal("x,z\n0,0\n3,high\n", ""),
             Contains("ground.csv:3:3: column \"z\": \"high\" is no number"));
  CHECK_THAT(refusal("x,z\n2,0,3,5\n", ""),
             Contains("file: ") && Contains("ground.csv:2: the line has 4 cells, more than the 2 names"));
  CHECK_THAT(refusal("x,z\n0,0\n", ""), Contains("ground.csv has 1 point\n"));
  CHECK_THAT(refusal("x,z\n", ""), Contains("ground.csv has 0 points"));
  CHECK_THAT(refusal("x,z\n0,0\n6,0\n", ", line: [[0 m, 0 m], [1 m, 0 m]]"),
             Contains("unknown key line") && Contains("either line or file"));
  CHECK_THAT(problems_of(std::string(kSoundDesign) + "limits: {stay_above: [{file: nowhere.csv}]}\n"),
             Contains("nowhere.csv") && Contains("No such file") && !Contains("has at least two"));
  CHECK_THAT(problems_of(std::string(kSoundDesign) +
                         "limits: {stay_above: [{line: [[0 m, 0 m], [6 m, 0 m]], unit: mm}]}\n"),
             Contains("unknown key unit"));
}

TEST_CASE("files that cannot be read are faults of files only where the design has no other") {
  const std::string ground = std::string(kSoundDesign) + "limits: {stay_above: [{file: nowhere.csv}]}\n";
  const std::string rules = std::string(kSoundDesign) + "rules: {sets: [nowhere.yaml]}\n";
  for (const std::string& text : {ground, rules}) {
    CHECK_THROWS_AS(parse_design(text, "d.yaml"), FileError);
    CHECK_THROWS_AS(parse_design(text + "colour: red\n", "d.yaml"), InputError);
    CHECK_THAT(problems_of(text + "colour: red\n"), Contains("nowhere.") && Contains("unknown key colour"));
  }
}

TEST_CASE("a line of ground by a coordinate of the site is refused where its other coordinate runs") {
  const TempDir place;
  const auto refusal = [&](double azimuth, const std::string& names, const std::string& columns,
                           const std::string& key) -> std::string {
    std::string csv = names + "\n";
    for (int i = 0; i <= 20; ++i) {
      csv += exact_text(0.3 * i) + "," + exact_text(0.3 * i * std::cos(azimuth)) + "," +
             exact_text(0.3 * i * std::sin(azimuth)) + "," + exact_text(key == "stay_above" ? -1.0 : 9.0) +
             "\n";
    }
    put_bytes(place / "ground.csv", csv);
    put_bytes(place / "d.yaml", std::string(kSoundDesign) + "limits: {" + key +
                                    ": [{file: ground.csv, columns: " + columns + "}]}\n");
    try {
      static_cast<void>(read_design(place / "d.yaml"));
      return {};
    } catch (const InputError& error) {
      return error.what();
    }
  };
  for (const std::string key : {"stay_above", "stay_below"}) {
    // 150 deg has an x that falls besides, 90 deg one that stays: what is told is the cause of both.
    for (const double degrees : {4.0, 45.0, 86.0, 90.0, 150.0, -30.0}) {
      CAPTURE(key, degrees);
      const double azimuth = degrees * std::numbers::pi / 180.0;
      CHECK_THAT(refusal(azimuth, "run_m,x_m,y_m,z_m", "[x_m, z_m]", key),
                 Contains("file: ground.csv: x_m is not the horizontal distance") &&
                     Contains("columns: [run_m, z_m], if run_m counts from the start of this track"));
      CHECK_THAT(refusal(azimuth, "way,Easting,Northing,z", "[Easting, z]", key),
                 Contains("Easting is not the horizontal distance") && Contains("Northing changes by") &&
                     Contains("if the heights do not depend on it"));
      CHECK(refusal(azimuth, "run_m,x_m,y_m,z_m", "[run_m, z_m]", key) == "");
      CHECK(refusal(azimuth, "way,x,offset,z", "[way, z]", key) == "");
    }
    CHECK(refusal(0.02, "way,x,y,z", "[x, z]", key) == "");
  }
}

TEST_CASE("a condition of gates may have a drag area of its own, where the body's mass is known") {
  const auto gates = [](const std::string& body, const std::string& slow) {
    return "glissade: 1\ntrack: {edge: {x: 0 m, z: 0 m}}\nbody: {friction_coefficient: 0.03, " + body +
           "}\ncenterline: {kind: in-run, gamma: 35 deg, alpha: 11 deg, r1: 103 m, t: 6.9 m, e1: 96 m, es: "
           "24 m}\n"
           "gates: {count: 3, slow: {" +
           slow + "}}\n";
  };
  const std::string rider = "mass: 68 kg, drag_area: 0.15 m^2";
  const Design design = parse_design(gates(rider, "drag_area: 0.17 m^2"), "d.yaml");
  CHECK(design.gates->slow->drag_area == 0.17);
  CHECK_THAT(problems_of(gates("drag: 0.0013 1/m", "drag_area: 0.17 m^2")),
             Contains("drag_area: of a body whose mass is not known"));
  CHECK_THAT(problems_of(gates(rider, "drag_area: 0.17 m^2, drag: 0.001 1/m")),
             Contains("both drag and drag_area are given"));
  CHECK_THAT(problems_of(gates(rider, "drag_area: -1 m^2")), Contains("drag_area: -1 m^2 is out of range"));
}
