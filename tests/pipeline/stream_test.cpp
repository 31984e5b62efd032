// A stream of bulk solid from the design file to its results: Roberts' worked examples, an integrator that shares
// nothing with the referee, choking, and what must not change when one thing is.

#include "glissade/trades/chute/stream.hpp"

#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/rules.hpp"
#include "glissade/trades/chute/wear.hpp"

#include "pipeline/rules/chute_rules.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace stream_test {

using namespace glissade;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// A chute of one arc, or straight with a curvature of 0.
struct Chute {
  double slope_deg = 45.0;  ///< at the start
  double length = 4.0;
  double curvature = 0.0;
  double mu = 0.25;
  double entry_speed = 0.5;
  double mass_flow = 20.0;  ///< [kg/s]
  double density = 770.0;
  double width = 0.3;
  double wall = 0.25;
  double ratio = 0.5;  ///< K_v
  std::string more;

  [[nodiscard]] std::string text() const {
    const auto number = [](double value) { return std::to_string(value); };
    return "glissade: 1\ntrack: {start: {x: 0 m, z: 20 m}}\nbody: {friction_coefficient: " + number(mu) +
           ", entry_speed: " + number(entry_speed) + " m/s}\nstream: {mass_flow: " + number(mass_flow) +
           " kg/s, bulk_density: " + number(density) + " kg/m^3, lateral_pressure_ratio: " + number(ratio) +
           "}\ncenterline: {kind: segments, entry_slope_angle: " + number(slope_deg) +
           " deg, segments: [{length: " + json(length).dump() + " m, curvature: " + json(curvature).dump() +
           " 1/m}]}\ncross_section: {kind: u-channel, width: " + number(width) +
           " m, wall_height: " + number(wall) + " m, thickness: 4 mm}\n" + more;
  }
  [[nodiscard]] Design design() const { return parse_design(text(), "d.yaml"); }
};

struct Passed {
  double speed = 0.0;
  double time = 0.0;
};

/// Roberts' equation by the classical Runge-Kutta method, in the speed and not in its square.
Passed integrated(const Chute& chute, int steps) {
  constexpr double kGravity = 9.81;
  const auto slope = [&](double s, double u) {
    const double angle = chute.slope_deg * kDegree - chute.curvature * s;
    const double depth = chute.mass_flow / (chute.density * chute.width * u);
    const double mu = chute.mu * (1.0 + chute.ratio * depth / chute.width);
    return (kGravity * std::sin(angle) - mu * (kGravity * std::cos(angle) + chute.curvature * u * u)) / u;
  };
  const double h = chute.length / steps;
  Passed at{chute.entry_speed, 0.0};
  for (int i = 0; i < steps; ++i) {
    const double s = h * i;
    const double u = at.speed;
    const double k1 = slope(s, u);
    const double k2 = slope(s + h / 2, u + h / 2 * k1);
    const double k3 = slope(s + h / 2, u + h / 2 * k2);
    const double k4 = slope(s + h, u + h * k3);
    at.speed += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    at.time += h / 6 * (1 / u + 2 / (u + h / 2 * k1) + 2 / (u + h / 2 * k2) + 1 / (u + h * k3));
  }
  return at;
}

Chute arc(double radius, double from_vertical_deg, double to_vertical_deg) {
  Chute chute;
  chute.slope_deg = 90.0 - from_vertical_deg;
  chute.length = radius * (to_vertical_deg - from_vertical_deg) * kDegree;
  chute.curvature = 1.0 / radius;
  return chute;
}

}  // namespace

TEST_CASE("a stream on straight chutes and arcs: Roberts' examples and an independent integrator") {
  Chute grain;  // vector C of the facts
  grain.slope_deg = 35.0;
  Chute ore = grain;
  ore.slope_deg = 45.0;
  ore.length = 5.0;
  ore.mu = 0.5;
  ore.entry_speed = 1.0;
  ore.mass_flow = 277.78;
  ore.density = 1000.0;
  ore.width = 1.0;
  ore.wall = 0.8;
  Chute grain_arc = arc(2.0, 20.0, 60.0);  // vector D
  grain_arc.entry_speed = 1.0;
  Chute ore_arc = arc(3.0, 0.0, 55.0);
  ore_arc.mu = 0.5;
  ore_arc.entry_speed = 4.0;
  ore_arc.mass_flow = 277.78;
  ore_arc.density = 1000.0;
  ore_arc.width = 1.0;
  ore_arc.wall = 0.8;
  struct Example {
    Chute chute;
    double speed, time, exit_depth;
  };
  for (const Example& e :
       {Example{grain, 5.327886, 1.390415, 0.0163}, Example{ore, 5.853409, 1.475125, 0.0475},
        Example{grain_arc, 3.704754, 0.521927, 0.0234}, Example{ore_arc, 5.090361, 0.571912, 0.0546}}) {
    const Design design = e.chute.design();
    const Track track = solve(design);
    REQUIRE(track.motion.arrived());
    CHECK(track.motion.exit_speed() == Approx(e.speed).epsilon(2e-7));
    CHECK(track.motion.travel_time() == Approx(e.time).epsilon(1e-6));
    const Passed passed = integrated(e.chute, 40000);
    CHECK(track.motion.exit_speed() == Approx(passed.speed).epsilon(1e-9));
    CHECK(track.motion.travel_time() == Approx(passed.time).epsilon(1e-9));
    const json stream = json::parse(track_json(design, track))["stream"];
    CHECK(stream["exit_depth_m"].get<double>() == Approx(e.exit_depth).epsilon(4e-3));
    CHECK(stream["exit_depth_m"].get<double>() * track.motion.exit_speed() ==
          Approx(e.chute.mass_flow / (e.chute.density * e.chute.width)).epsilon(1e-12));
    CHECK_FALSE(stream["choked"].get<bool>());
    CHECK(stream["choke"].is_null());
  }
}

TEST_CASE("the deepest place, the most friction and the margin agree with one another") {
  Chute chute = arc(2.0, 10.0, 80.0);
  chute.entry_speed = 1.2;
  const Design design = chute.design();
  const Track track = solve(design);
  const StreamFacts facts = stream_facts(track.motion).value();
  CHECK(facts.equivalent_friction.value ==
        Approx(chute.mu * (1.0 + chute.ratio * facts.deepest.value / chute.width)).epsilon(1e-12));
  CHECK(facts.equivalent_friction.arc_length == facts.deepest.arc_length);
  CHECK(facts.filling.value == Approx(facts.deepest.value / chute.wall).epsilon(1e-12));
  CHECK(facts.margin() == Approx(1.0 - facts.filling.value));
  CHECK_FALSE(stream_facts(Motion(track.centerline, Body{}, 9.81)));
  // The flow that chokes it, from both sides.
  const double most = choking_mass_flow(track.centerline, track.motion.body(), 9.81).value();
  CHECK(most > chute.mass_flow);
  for (const double factor : {0.9999, 1.0001}) {
    const Body body = with_flow(track.motion.body(), factor * most / chute.mass_flow);
    CHECK(Motion(track.centerline, body, 9.81).law_end().has_value() == (factor > 1.0));
  }
}

TEST_CASE("a stream chokes where it is as deep as its wall, with place, depth and what to try") {
  Chute chute = arc(2.0, 20.0, 88.0);
  chute.mu = 0.7;
  chute.entry_speed = 1.0;
  chute.wall = 0.12;
  const Design design = chute.design();
  const Track track = solve(design);
  const StreamFacts facts = stream_facts(track.motion).value();
  REQUIRE(facts.choke);
  CHECK(facts.choke->over_wall);
  CHECK(facts.choke->depth == Approx(0.12).epsilon(1e-9));
  CHECK(facts.filling.value == 1.0);
  CHECK_FALSE(facts.exit_depth);
  CHECK_THAT(ride_problem(design, track)->what, Contains("the stream chokes after"));
  CHECK_THAT(ride_problem(design, track)->why, Contains("as high as the wall: it spills over"));
  const json document = json::parse(track_json(design, track));
  CHECK(document["status"] == "choked");
  CHECK(document["stream"]["choked"] == true);
  CHECK(document["stream"]["choke"]["bound_m"].get<double>() == 0.12);
  CHECK(document["stream"]["exit_depth_m"].is_null());
  CHECK(document["travel_time_s"].is_null());
  // It would not arrive as a single grain either.
  CHECK(document["stream"]["choking_mass_flow_kg_per_s"] == 0.0);
  // A higher wall carries it further, and beyond the width no wall helps.
  double reached = track.motion.distance();
  for (const double wall : {0.15, 0.2, 0.29}) {
    chute.wall = wall;
    const Track higher = solve(chute.design());
    CHECK(higher.motion.distance() >= reached);
    reached = higher.motion.distance();
  }
  chute.wall = 0.6;
  const StreamFacts wide = stream_facts(solve(chute.design()).motion).value();
  REQUIRE(wide.choke);
  CHECK_FALSE(wide.choke->over_wall);
  CHECK(wide.choke->bound == 0.3);
}

TEST_CASE(
    "wear: Roberts' factor at the exit of his arcs, the peak where the load is, and Archard's thickness") {
  Chute grain = arc(2.0, 20.0, 60.0);
  grain.entry_speed = 1.0;
  const Design design = parse_design(
      [&] {
        std::string text = grain.text();
        const std::string part = "lateral_pressure_ratio";
        return text.replace(text.find(part), 0,
                            "liner_plate: {thickness: 10 mm, hardness: 4 GPa, wear_coefficient: 2e-4}, ");
      }(),
      "d.yaml");
  const Track track = solve(design);
  CHECK(stream_state(track.motion, track.motion.distance()).floor_wear == Approx(153.6).epsilon(4e-4));
  const WearFacts wear = wear_at_frictions(track).facts;
  CHECK(wear.floor.arc_length == Approx(track.motion.highest_load().arc_length).margin(1e-6));
  CHECK(wear.wall.value == Approx(wear.floor.value * 0.5 / (2.0 * 0.6)).epsilon(1e-9));
  CHECK(wear.mean_floor < wear.floor.value);
  REQUIRE(wear.plates.size() == 1);
  CHECK(wear.plates[0].from <= wear.floor.arc_length);
  CHECK(wear.plates[0].to >= wear.floor.arc_length);
  // k p v_slip/H with p = rho H N and v_slip = K_c u.
  const StreamState worst = stream_state(track.motion, wear.floor.arc_length);
  const double slip = 0.6 * track.motion.at(wear.floor.arc_length).speed;
  const double rate = 2e-4 * worst.floor_pressure * slip / 4e9;
  const LinerLoss loss = liner_loss(design, wear).value();
  CHECK(loss.per_1000_h == Approx(rate * 3.6e6).epsilon(1e-9));
  CHECK(loss.per_megatonne == Approx(rate * 1e9 / 20.0).epsilon(1e-9));
  CHECK(loss.life_hours == Approx(0.01 / rate / 3600.0).epsilon(1e-9));
  const json told = json::parse(track_json(design, track))["wear"];
  CHECK(told["loss_mm_per_1000_h"].get<double>() == Approx(rate * 3.6e9).epsilon(1e-9));
}

TEST_CASE(
    "least peak wear: between two points without crests the straight chute, priced in seconds and in wear") {
  const Design design = parse_design(R"(glissade: 1
name: ore
track:
  start: {x: 0 m, z: 5.9 m}
  finish: {x: 4.3 m, z: 0 m}
body:
  friction_angle: {low: 24 deg, nominal: 27 deg, high: 31 deg}
  entry_speed: 2.5 m/s
stream: {mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}
centerline: {kind: fastest}
limits: {concave: true, objective: least_peak_wear}
cross_section: {kind: u-channel, width: 800 mm, wall_height: 500 mm, thickness: 10 mm}
)",
                                     "d.yaml");
  const Track track = solve(design);
  const double straight = 650.0 / 3.6 * 0.6 * math::tan(Angle::from_degrees(31.0).radians()) *
                          design.gravity * 4.3 / math::hypot(4.3, 5.9) / 0.8;
  const json told = json::parse(track_json(design, track));
  CHECK(told["wear"]["highest_floor_wear_w_per_m2"].get<double>() == Approx(straight).epsilon(1e-4));
  const json& fastest = told["fastest_within_limits"];
  CHECK(fastest["highest_floor_wear_w_per_m2"].get<double>() > 1.5 * straight);
  CHECK(fastest["price_s"].get<double>() > 0.0);
  CHECK(fastest["price_s"].get<double>() + fastest["travel_time_s"].get<double>() ==
        Approx(track.straight_travel_time().value()).epsilon(1e-4));
  CHECK(track.search->objective.kind == ObjectiveKind::least_peak_wear);
}

TEST_CASE("a stream of next to nothing chokes where a sliding point stalls") {
  Chute chute = arc(2.0, 20.0, 88.0);
  chute.mu = 0.7;
  chute.entry_speed = 1.0;
  chute.mass_flow = 1e-6;
  const Design design = chute.design();
  const Track track = solve(design);
  Body point = track.motion.body();
  point.law = nullptr;
  const Motion slides(track.centerline, point, 9.81);
  REQUIRE(slides.stall());
  const StreamFacts facts = stream_facts(track.motion).value();
  REQUIRE(facts.choke);
  CHECK(facts.choke->arc_length == Approx(slides.stall()->arc_length).epsilon(1e-5));
  CHECK(facts.choke->depth == Approx(chute.wall).epsilon(1e-12));
  CHECK(facts.choke->speed == Approx(1e-6 / (770.0 * 0.3 * chute.wall)).epsilon(1e-12));
  CHECK(facts.deepest.value == facts.choke->depth);
  const json document = json::parse(track_json(design, track));
  CHECK(document["status"] == "choked");
  CHECK(document["stall"].is_null());
  CHECK(document["stream"]["choked"] == true);
  CHECK(document["law_end"]["bound"].get<double>() == Approx(chute.wall).epsilon(1e-12));
  CHECK_THAT(ride_problem(design, track)->what, Contains("the stream chokes after"));
  // What it had at the start it has lost on the way, or it is its height.
  const MotionState end = track.motion.at(track.motion.distance());
  CHECK(end.friction_loss + 0.5 * end.speed * end.speed ==
        Approx(0.5 + 9.81 * track.centerline->at(end.arc_length).drop).epsilon(1e-12));
}

TEST_CASE("a stream too small to be as deep as its wall at 1 mm/s chokes all the same") {
  Chute chute;
  chute.slope_deg = 21.49;
  chute.length = 1.441;
  chute.mu = 0.574;
  chute.entry_speed = 3.36;
  chute.mass_flow = 0.590752 / 3.6;
  chute.density = 2347.1;
  chute.width = 0.896;
  chute.wall = 0.743;
  chute.ratio = 0.72;
  const Design design = parse_design(
      std::regex_replace(chute.text(), std::regex("1/m\\}\\]"), "1/m}, {length: 0.765 m, radius: 1.66 m}]"),
      "d.yaml");
  const Track track = solve(design);
  const StreamFacts facts = stream_facts(track.motion).value();
  REQUIRE(facts.choke);
  CHECK(facts.choke->over_wall);
  CHECK(facts.choke->depth == Approx(0.743).epsilon(1e-12));
  CHECK(facts.filling.value == 1.0);
  CHECK(json::parse(track_json(design, track))["status"] == "choked");
}

TEST_CASE("a limit on wear holds all over a range, where mu N is greatest between its ends, too") {
  const auto wear_at = [](const Design& design, const Track& track, double degrees) {
    const Track ridden =
        ride_at(design, track.centerline, Friction::from_angle(Angle::from_degrees(degrees)));
    return stream_peak(ridden.motion, &StreamState::floor_wear).value;
  };
  constexpr const char* kRest =
      "stream: {mass_flow: 100 t/h, bulk_density: 1600 kg/m^3}\n"
      "cross_section: {kind: u-channel, width: 400 mm, wall_height: 250 mm, thickness: 4 mm}\n";
  // Held against the ends and the nominal friction alone it was "1128 W/m^2, kept", and 1397 W/m^2 at 35 deg.
  const Design drawn = parse_design(
      std::string("glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}}\n"
                  "body: {friction_angle: {low: 8 deg, nominal: 20 deg, high: 44 deg}, entry_speed: 3 m/s}\n"
                  "centerline: {kind: segments, entry_slope_angle: 48 deg, "
                  "segments: [{length: 6 m}, {radius: 1 m, to_slope_angle: 20 deg}]}\n"
                  "limits: {highest_floor_wear: 1200 W/m^2}\n") +
          kRest,
      "d.yaml");
  const Track bend = solve(drawn);
  const json told = json::parse(track_json(drawn, bend));
  const auto found_row = std::find_if(told["limits"].begin(), told["limits"].end(),
                                      [](const json& one) { return one["limit"] == "highest_floor_wear"; });
  REQUIRE(found_row != told["limits"].end());
  const json& row = *found_row;
  CHECK(row["friction"] == "in-between");
  CHECK_FALSE(row["kept"].get<bool>());
  double most = 0.0;
  for (double degrees = 8.0; degrees <= 44.0; degrees += 0.25)
    most = std::max(most, wear_at(drawn, bend, degrees));
  CHECK(row["reached"].get<double>() >= most * (1.0 - 1e-9));
  CHECK(row["reached"].get<double>() <= most * (1.0 + 1e-3));
  CHECK(told["wear"]["highest_floor_wear_w_per_m2"].get<double>() ==
        Approx(row["reached"].get<double>()).epsilon(1e-6));
  CHECK(told["wear"]["friction"] == "in-between");
  if (!testing::thorough()) return;  // the search takes seconds
  // What is searched for keeps it all over the range, and leaves nothing of it: "optimal" at 900 W/m^2 had 995 at 29 deg.
  const Design searched = parse_design(
      std::string("glissade: 1\ntrack: {start: {x: 0 m, z: 0 m}, finish: {x: 4.6 m, z: -4.9 m}}\n"
                  "body: {friction_angle: {low: 8 deg, nominal: 20 deg, high: 42 deg}, entry_speed: 3 m/s}\n"
                  "limits: {highest_floor_wear: 900 W/m^2, entry_slope_angle: {highest: 60 deg}, "
                  "exit_slope_angle: 25 deg, smallest_radius: 1 m}\n") +
          kRest,
      "f.yaml");
  const Track found = solve(searched);
  REQUIRE(found.search);
  CHECK(found.search->status == OptimizeStatus::optimal);
  double peak = 0.0;
  for (double degrees = 8.0; degrees <= 42.0; degrees += 0.5)
    peak = std::max(peak, wear_at(searched, found, degrees));
  CHECK(peak <= 900.0 * (1.0 + 1e-4));
  CHECK(peak > 0.999 * 900.0);
}

TEST_CASE("wear is told where a bend ends: upstream of a drop of the curvature") {
  // 0.07 m of a bend of 1 m, then straight: the load drops where the bend ends.
  const char* const text = R"(glissade: 1
track: {start: {x: 0 m, z: 100 m}}
body: {friction_coefficient: 0.3, entry_speed: 2 m/s}
stream: {mass_flow: 100 t/h, bulk_density: 1500 kg/m^3, slip_ratio: 0.6, liner_plate: {thickness: 12 mm, hardness: 4 GPa, wear_coefficient: 5e-4}}
centerline: {kind: segments, entry_slope_angle: 85 deg, segments: [{length: 0.07 m, radius: 1 m}, {length: 29.93 m}]}
cross_section: {kind: u-channel, width: 500 mm, wall_height: 300 mm, thickness: 5 mm}
limits: {highest_floor_wear: 60 W/m^2}
)";
  const Design design = parse_design(text, "d.yaml");
  const Track track = solve(design);
  Chute bend;
  bend.slope_deg = 85.0;
  bend.length = 0.07;
  bend.curvature = 1.0;
  bend.mu = 0.3;
  bend.entry_speed = 2.0;
  bend.mass_flow = 100.0 / 3.6;
  bend.density = 1500.0;
  bend.width = 0.5;
  const double speed = integrated(bend, 400).speed;
  const double load = 9.81 * std::cos(85.0 * kDegree - 0.07) + speed * speed;
  const double wear = 100.0 / 3.6 * 0.6 * 0.3 * load / 0.5;
  const json told = json::parse(track_json(design, track));
  CHECK(told["wear"]["highest_floor_wear_w_per_m2"].get<double>() == Approx(wear).epsilon(1e-9));
  CHECK(told["wear"]["highest_floor_wear_at_m"].get<double>() == Approx(0.07));
  CHECK(told["wear"]["highest_wall_wear_w_per_m2"].get<double>() == Approx(wear * 0.5 / 1.2).epsilon(1e-9));
  CHECK(told["wear"]["wear_plates"].size() == 1);
  CHECK(told["wear"]["wear_plates"][0]["to_m"].get<double>() == Approx(0.07));
  // Archard: k W_c/(mu H), through 12 mm.
  CHECK(told["wear"]["liner_life_h"].get<double>() ==
        Approx(0.012 / (5e-4 * wear / 0.3 / 4e9) / 3600.0).epsilon(1e-9));
  const json& limits = told["limits"];
  const auto row = std::find_if(limits.begin(), limits.end(),
                                [](const json& one) { return one["limit"] == "highest_floor_wear"; });
  REQUIRE(row != limits.end());
  CHECK((*row)["reached"].get<double>() == Approx(wear).epsilon(1e-9));
  const double straight = 100.0 / 3.6 * 0.6 * 0.3 * 9.81 * std::cos(85.0 * kDegree - 0.07) / 0.5;
  CHECK(told["wear"]["mean_floor_wear_w_per_m2"].get<double>() > straight);
  const std::vector<Judgement> all = judge_rules(design, track);
  const auto rule = std::find_if(all.begin(), all.end(),
                                 [](const Judgement& one) { return one.rule.id == "chute.9.wear"; });
  REQUIRE(rule != all.end());
  CHECK(rule->verdict == RuleVerdict::warn);
  CHECK(*rule->value > 4.2);
}

TEST_CASE("wear plates end where the floor wears half as much as at its peak") {
  const Design design = parse_design(R"(glissade: 1
track: {start: {x: 0 m, z: 100 m}}
body: {friction_coefficient: 0.3, entry_speed: 2 m/s}
stream: {mass_flow: 100 t/h, bulk_density: 1500 kg/m^3}
centerline: {kind: segments, entry_slope_angle: 50 deg, segments: [{length: 7 m}, {length: 2 m, radius: 4 m}, {length: 5 m}]}
cross_section: {kind: u-channel, width: 500 mm, wall_height: 300 mm, thickness: 5 mm}
)",
                                     "d.yaml");
  const Track track = solve(design);
  const WearFacts facts = wear_of({&track.motion});
  REQUIRE_FALSE(facts.plates.empty());
  const auto share = [&](double s) { return stream_state(track.motion, s).floor_wear / facts.floor.value; };
  int crossed = 0;
  for (const WearStretch& plate : facts.plates) {
    for (const auto& [end, beyond] : {std::pair{plate.from, -1e-6}, std::pair{plate.to, 1e-6}}) {
      if (end == 0.0 || end == track.motion.distance()) continue;
      ++crossed;
      CAPTURE(end, share(end));
      CHECK(share(end) >= 0.5);
      CHECK(share(end + beyond) < 0.5);
    }
  }
  CHECK(crossed > 0);
}

TEST_CASE("where friction changes along the track, limits tell the wear of each place as the wear does") {
  const Design design = parse_design(R"(glissade: 1
track: {start: {x: 0 m, z: 20 m}}
body: {friction: [{from: 0 m, angle: 20 deg}, {from: 2 m, angle: 25 deg}], entry_speed: 2 m/s}
stream: {mass_flow: 300 t/h, bulk_density: 1600 kg/m^3}
centerline: {kind: segments, entry_slope_angle: 50 deg, segments: [{length: 5 m}]}
cross_section: {kind: u-channel, width: 800 mm, wall_height: 500 mm, thickness: 10 mm}
limits: {highest_floor_wear: 190 W/m^2}
)",
                                     "d.yaml");
  const Track track = solve(design);
  const double wear = 300.0 / 3.6 * 0.6 * std::tan(25.0 * kDegree) * 9.81 * std::cos(50.0 * kDegree) / 0.8;
  const json told = json::parse(track_json(design, track));
  CHECK(told["wear"]["highest_floor_wear_w_per_m2"].get<double>() == Approx(wear).epsilon(1e-9));
  for (const json& row : told["limits"]) {
    if (row["limit"] == "highest_floor_wear") {
      CHECK(row["reached"].get<double>() == Approx(wear).epsilon(1e-9));
    }
  }
}

TEST_CASE("without pressure on the walls a stream rides as a sliding point does") {
  Chute chute = arc(2.0, 20.0, 60.0);
  chute.ratio = 0.0;
  const Track track = solve(chute.design());
  Body point = track.motion.body();
  point.law = nullptr;
  const Motion slides(track.centerline, point, 9.81);
  CHECK(track.motion.travel_time() == Approx(slides.travel_time()).epsilon(1e-12));
  CHECK(track.motion.exit_speed() == Approx(slides.exit_speed()).epsilon(1e-12));
}

TEST_CASE("a chute k times as large with k^2.5 times the flow is the same stream") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 10; ++i) {
    Chute chute = arc(random.between(1.0, 4.0), random.between(5.0, 30.0), random.between(40.0, 60.0));
    chute.entry_speed = random.between(1.0, 3.0);
    chute.mu = random.between(0.1, 0.5);
    const double k = 4.0;  // a power of two: nothing is rounded
    Chute large = chute;
    large.length *= k;
    large.curvature /= k;
    large.width *= k;
    large.wall *= k;
    large.entry_speed *= std::sqrt(k);
    large.mass_flow *= std::pow(k, 2.5);
    const Track small = solve(chute.design());
    const Track big = solve(large.design());
    const StreamFacts a = stream_facts(small.motion).value();
    const StreamFacts b = stream_facts(big.motion).value();
    CHECK(b.deepest.value == Approx(k * a.deepest.value).epsilon(1e-5));
    CHECK(b.equivalent_friction.value == Approx(a.equivalent_friction.value).epsilon(1e-5));
    CHECK(big.motion.exit_speed() == Approx(std::sqrt(k) * small.motion.exit_speed()).epsilon(1e-5));
  }
}

TEST_CASE("even burden depth is the constant-speed curve, at the friction of that depth") {
  const std::string text =
      "glissade: 1\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 4.3 m, z: 0 m}}\n"
      "body: {friction_angle: {low: 25 deg, nominal: 27 deg}, entry_speed: 4 m/s}\n"
      "stream: {mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}\ncenterline: {kind: constant-speed}\n"
      "cross_section: {kind: u-channel, width: 800 mm, wall_height: 500 mm, thickness: 10 mm}\n";
  const Design design = parse_design(text, "d.yaml");
  const Track track = solve(design);
  REQUIRE(track.motion.arrived());
  const double depth = 650.0 / 3.6 / (1.6 * 0.8 * 4.0);
  for (int i = 0; i <= 20; ++i) {
    const double s = std::min(track.centerline->length(), track.centerline->length() * i / 20.0);
    CHECK(track.motion.at(s).speed == Approx(4.0).epsilon(1e-9));
    CHECK(track.motion.quantity(BulkStream::kDepth, s) == Approx(depth / 1000.0).epsilon(1e-9));
  }
  std::string slow = text;
  slow.replace(slow.find("4 m/s"), 5, "1 m/s");
  try {
    static_cast<void>(solve(parse_design(slow, "d.yaml")));
    FAIL("a speed that no track keeps");
  } catch (const InputError& error) {
    CHECK_THAT(error.what(), Contains("no track between these points keeps a stream at 1 m/s") &&
                                 Contains("an entry_speed of at least"));
  }
}

TEST_CASE(
    "a speed that no track keeps is below the least one that is named, and above that every speed is kept") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int refused = 0;
  int kept = 0;
  const auto least_named = [](const std::string& text) -> std::optional<double> {
    try {
      const Track track = solve(parse_design(text, "d.yaml"));
      const Body& body = track.motion.body();
      const double v = body.entry_speed * body.entry_speed;
      const double factor = body.law->resistance(0.0, v).factor;
      // What is rounded grows: what is slower is deeper and rubs more, and presses more on a crest.
      const double mu = factor * body.friction.coefficient();
      const double grows =
          std::exp((1.0 - 1.0 / factor) * 9.81 * track.endpoints.drop / v + 2.0 * mu * std::atan(mu));
      if (const double rounding = 1e-11 * grows; rounding < 1e-3) {
        REQUIRE(track.motion.arrived());
        CHECK(track.motion.exit_speed() == Approx(body.entry_speed).epsilon(rounding));
      }
      return {};
    } catch (const InputError& error) {
      const std::string what = error.what();
      INFO(what);
      // How deep it comes in is another question.
      if (what.find("the stream enters") != std::string::npos) return 0.0;
      std::smatch found;
      REQUIRE(std::regex_search(what, found, std::regex("an entry_speed of at least ([0-9.e-]+) m/s")));
      CHECK_THAT(what, Contains("no track between these points keeps a stream at") &&
                           Contains("From " + found[1].str() + " m/s on there is one at every speed"));
      return std::stod(found[1]);
    }
  };
  for (int draw = 0; draw < 60; ++draw) {
    const double run = random.between(0.5, 8.0);
    const double drop = random.between(0.3, 6.0);
    const double chord = std::atan2(drop, run) / kDegree;
    const double apart = draw % 2 == 0 ? random.between(-2.5, 1.0) : random.between(-0.4, 0.1);
    const double friction = std::max(0.2, chord + apart);
    const double flow = random.between(1.0, 30.0);
    const auto text = [&](double speed) {
      return fmt::format(
          "glissade: 1\ntrack: {{start: {{x: 0 m, z: {} m}}, finish: {{x: {} m, z: 0 m}}}}\n"
          "body: {{friction_angle: {} deg, entry_speed: {} m/s}}\n"
          "stream: {{mass_flow: {} t/h, bulk_density: 800 kg/m^3}}\ncenterline: {{kind: constant-speed}}\n"
          "cross_section: {{kind: u-channel, width: 300 mm, wall_height: 200 mm, thickness: 3 mm}}\n",
          drop, run, friction, speed, flow);
    };
    double named = 0.0;
    for (int i = 0; i < 25; ++i) {
      const double speed = random.between(0.1, 3.0);
      CAPTURE(run, drop, friction, flow, speed);
      if (const auto least = least_named(text(speed))) {
        if (*least == 0.0) continue;
        CHECK(speed < *least);
        named = std::max(named, *least);
        ++refused;
      } else {
        ++kept;
      }
    }
    if (named == 0.0) continue;
    CAPTURE(run, drop, friction, flow, named);
    for (const double more : {1.0, 1.0001, 1.003, 1.03, 1.1, 1.3, 2.0, 5.0}) {
      CAPTURE(more);
      if (named * more < 100.0) CHECK_FALSE(least_named(text(named * more)));
    }
  }
  CHECK(refused > 100);
  CHECK(kept > 300);
}

TEST_CASE(
    "a stream whose speed rounding decides arrives with a speed, or chokes: never does it arrive at rest") {
  for (const double speed : {0.5797, 0.5813388, 0.585, 0.597, 0.61}) {
    CAPTURE(speed);
    const Design design = parse_design(
        fmt::format(
            "glissade: 1\ntrack: {{start: {{x: 0 m, z: 5.3253982284 m}}, finish: {{x: 0.8020772461 m, z: 0 "
            "m}}}}\n"
            "body: {{friction_angle: 81.2737873241 deg, entry_speed: {} m/s}}\n"
            "stream: {{mass_flow: 25.584128112 t/h, bulk_density: 800 kg/m^3}}\n"
            "centerline: {{kind: constant-speed}}\n"
            "cross_section: {{kind: u-channel, width: 300 mm, wall_height: 200 mm, thickness: 3 mm}}\n",
            speed),
        "d.yaml");
    const Track track = solve(design);
    CHECK(track.motion.exit_speed() > 0.0);
    CHECK(track.motion.highest(BulkStream::kDepth).value <= 0.2 * (1.0 + 1e-9));
  }
}

TEST_CASE(
    "a stream close to the friction of the chord keeps each speed that a shot from the start finds a track "
    "for") {
  // Slopes at the start by shooting with Runge-Kutta steps, of 3 m of run and 4 m of drop.
  const auto starts_at = [](double friction, double speed) {
    const Design design = parse_design(
        fmt::format(
            "glissade: 1\ntrack: {{start: {{x: 0 m, z: 10 m}}, finish: {{x: 3 m, z: 6 m}}}}\n"
            "body: {{friction_angle: {} deg, entry_speed: {} m/s}}\n"
            "stream: {{mass_flow: 20 t/h, bulk_density: 800 kg/m^3}}\ncenterline: {{kind: constant-speed}}\n"
            "cross_section: {{kind: u-channel, width: 300 mm, wall_height: 200 mm, thickness: 3 mm}}\n",
            friction, speed),
        "d.yaml");
    return solve(design).centerline->slope_angle(0.0) / kDegree;
  };
  constexpr double kShooting = 0.002;  // accuracy: of the slopes below [deg]
  CHECK(starts_at(52.0, 1.0) == Approx(58.135).margin(kShooting));
  CHECK(starts_at(52.0, 1.36) == Approx(64.607).margin(kShooting));
  CHECK(starts_at(52.0, 1.64) == Approx(63.786).margin(kShooting));
  CHECK(starts_at(51.6, 1.06) == Approx(82.119).margin(kShooting));
  CHECK(starts_at(51.8, 1.82) == Approx(66.356).margin(kShooting));
}

TEST_CASE("even burden depth is refused where friction or width changes before the finish, and only there") {
  const auto of = [](const std::string& friction, const std::string& width, const std::string& p = "") {
    return solve(parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 4.3 m, z: 0 m}}\nbody: {" + friction +
            ", entry_speed: 4 m/s}\nstream: {mass_flow: 650 t/h, bulk_density: 1600 kg/m^3}\n"
            "centerline: {kind: constant-speed" +
            p + "}\ncross_section: {kind: u-channel, width: " + width +
            ", wall_height: 500 mm, thickness: 10 mm}\n",
        "d.yaml"));
  };
  const auto problem = [&](const std::string& friction, const std::string& width) {
    try {
      static_cast<void>(of(friction, width));
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  const auto then = [](double from, int angle) {
    return fmt::format("friction: [{{from: 0 m, angle: 27 deg}}, {{from: {} m, angle: {} deg}}]", from,
                       angle);
  };
  const auto narrower = [](double from) {
    return fmt::format(
        "[{{at: 0 m, width: 800 mm}}, {{at: {} m, width: 800 mm}}, {{at: {} m, width: 700 mm}}]", from,
        from + 1.0);
  };
  const Track plain = of("friction_angle: 27 deg", "800 mm");
  const double length = plain.centerline->length();
  const double chord = std::hypot(4.3, 3.0);
  REQUIRE(length > chord + 1e-3);
  for (const double from : {2.0, chord, 0.5 * (chord + length), length - 1e-6}) {
    CAPTURE(from);
    CHECK_THAT(problem(then(from, 24), "800 mm"),
               Contains("d.yaml:3:") && Contains("constant-speed without p, where friction changes along") &&
                   Contains("one friction all along, or kind: fastest with objective: even_speed") &&
                   !Contains("p: 9"));
    CHECK_THAT(problem("friction_angle: 27 deg", narrower(from)),
               Contains("d.yaml:6:") && Contains("without p, where the width changes along the track") &&
                   Contains("one width all along"));
  }
  const auto same = [&](const Track& track) {
    REQUIRE(track.motion.arrived());
    CHECK(track.centerline->length() == length);
    CHECK(track.motion.travel_time() == Approx(plain.motion.travel_time()).epsilon(1e-12));
    CHECK(track.motion.exit_speed() == Approx(4.0).epsilon(1e-9));
  };
  same(of(then(length + 1e-6, 24), "800 mm"));
  same(of(then(100.0, 24), "800 mm"));
  same(of(then(2.0, 27), "800 mm"));
  same(of("friction_angle: 27 deg", narrower(length + 1e-6)));
  CHECK_NOTHROW(of(then(2.0, 24), narrower(2.0), ", p: 16 m^2/s^2"));
}

TEST_CASE("rides over the friction range tell each its stream; more friction is a deeper one") {
  Chute chute = arc(2.0, 20.0, 60.0);
  std::string text = chute.text();
  const std::string one = "friction_coefficient: 0.250000";
  text.replace(text.find(one), one.size(), "friction_coefficient: {low: 0.2, nominal: 0.25, high: 0.35}");
  const Design design = parse_design(text, "d.yaml");
  const json rides = json::parse(track_json(design, solve(design)))["rides"];
  REQUIRE(rides.size() == 3);
  for (std::size_t i = 1; i < 3; ++i) {
    CHECK(rides[i]["stream"]["exit_depth_m"].get<double>() >
          rides[i - 1]["stream"]["exit_depth_m"].get<double>());
  }
}

TEST_CASE(
    "rides at other frictions and flows move all friction along the track alike, and take none of what has "
    "none") {
  for (const double least : {1.0, 25.0}) {
    const Design design = parse_design(fmt::format(R"(glissade: 1
track: {{start: {{x: 0 m, z: 20 m}}}}
body: {{friction: [{{from: 0 m, angle: 20 deg}}, {{from: 2 m, angle: {} deg}}], entry_speed: 2 m/s}}
stream: {{mass_flow: 300 t/h, bulk_density: 1600 kg/m^3}}
centerline: {{kind: segments, entry_slope_angle: 50 deg, segments: [{{length: 5 m}}]}}
cross_section: {{kind: u-channel, width: 800 mm, wall_height: 500 mm, thickness: 10 mm}}
)",
                                                   least),
                                       "d.yaml");
    const auto rides = pipeline::what_if_rides(design, make_centerline(design));
    REQUIRE(rides.size() == 35);
    double lowest = 90.0;
    for (const pipeline::WhatIfRide& ride : rides) {
      const Body& body = ride.motion.body();
      REQUIRE(body.friction_changes.size() == 1);
      const double start = body.friction.angle().degrees();
      lowest = std::min(lowest, start);
      CHECK(body.friction_changes[0].friction.angle().degrees() - start == Approx(least - 20.0).margin(1e-9));
    }
    CHECK(lowest == Approx(20.0 - std::min(3.0, least)).margin(1e-9));
  }
}

}  // namespace stream_test
