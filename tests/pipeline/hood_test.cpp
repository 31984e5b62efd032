// Hood and spoon: what a design tells of its hood, the two chosen together, its solid, what it must keep clear of, and
// input that makes no hood.

#include "glissade/trades/chute/hood.hpp"

#include "glissade/design/write.hpp"
#include "glissade/motion/stall_friction.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/frozen.hpp"
#include "glissade/pipeline/json.hpp"
#include "glissade/pipeline/rules.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace hood_test {

using namespace glissade;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const std::string kHood = "hood: {radius: 1 m, impact_angle: 12 deg, exit_angle: 78 deg, drop: 400 mm}\n";

/// 400 t/h of ore from a fast belt; the spoon is straight unless told otherwise.
std::string transfer(
    const std::string& hood = kHood, const std::string& more = "",
    const std::string& centerline = "centerline: {kind: straight}\n",
    const std::string& friction = "friction_angle: {low: 24 deg, nominal: 27 deg, high: 31 deg}") {
  return "glissade: 1\ntrack: {start: {x: 0 m, z: 3 m}, finish: {x: 1.2 m, z: 1.4 m}}\nbody: {" + friction +
         "}\nstream: {mass_flow: 400 t/h, bulk_density: 1600 kg/m^3, lump_size: 60 mm}\n"
         "feed: {kind: belt, belt_speed: 3.6 m/s, pulley_radius: 400 mm, drop: 200 mm}\n" +
         hood + "discharge: {belt_speed: 3 m/s, drop: 300 mm}\n" + centerline +
         "cross_section: {kind: u-channel, width: 800 mm, wall_height: 400 mm, thickness: 8 mm}\n" + more;
}

std::string problems(const std::string& text) {
  try {
    static_cast<void>(parse_design(text, "d.yaml"));
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

double number(const json& object, const char* key) {
  return object.at(key).get<double>();
}

}  // namespace

TEST_CASE("a transfer by hand: feed, hood, fall and spoon hand over to one another") {
  const Design design = parse_design(transfer(), "d.yaml");
  const Track track = solve(design);
  const json document = json::parse(track_json(design, track));
  const json& feed = document["feed"];
  const json& hood = document["hood"];
  // Down to the hood by 200 mm.
  const double falls = std::sqrt(3.6 * 3.6 + 2.0 * 9.81 * 0.2);
  const double way = std::atan2(std::sqrt(2.0 * 9.81 * 0.2), 3.6);
  CHECK(number(feed, "speed_m_per_s") == Approx(falls).epsilon(1e-12));
  CHECK(number(hood, "entry_slope_angle_deg") == Approx(way / kDegree + 12.0).epsilon(1e-12));
  const double mu = std::tan(27.0 * kDegree);
  const double enters = falls * (std::cos(12.0 * kDegree) - mu * std::sin(12.0 * kDegree));
  CHECK(number(hood, "entry_speed_m_per_s") == Approx(enters).epsilon(1e-12));
  CHECK(number(hood, "contact_at_entry") ==
        Approx(enters * enters / (9.81 * std::cos(way + 12.0 * kDegree))).epsilon(1e-12));
  // The hood's end is where its fall begins, and that ends on the start of the spoon.
  const double leaves = number(hood, "exit_speed_m_per_s");
  CHECK(number(hood, "landing_speed_m_per_s") ==
        Approx(std::sqrt(leaves * leaves + 2.0 * 9.81 * 0.4)).epsilon(1e-12));
  CHECK(number(hood, "edge_height_m") == Approx(0.4).epsilon(1e-12));
  CHECK(number(hood, "edge_run_m") == Approx(-number(hood, "reach_m")).epsilon(1e-9));
  const double angle = number(hood, "landing_angle_deg") * kDegree - track.centerline->slope_angle(0.0);
  CHECK(number(document, "entry_speed_m_per_s") ==
        Approx(number(hood, "landing_speed_m_per_s") * (std::cos(angle) - mu * std::sin(angle)))
            .epsilon(1e-12));
  // The pulley lies behind the hood by the way of the feed.
  CHECK(number(feed, "pulley_run_m") ==
        Approx(number(hood, "entry_run_m") - number(feed, "reach_m")).epsilon(1e-12));
  CHECK(number(hood, "transfer_time_s") ==
        Approx(number(feed, "time_s") + number(hood, "travel_time_s") + number(hood, "fall_time_s") +
               number(document, "travel_time_s"))
            .epsilon(1e-12));
  CHECK(hood["landing_spread_m"][0].get<double>() < 0.0);
  CHECK(hood["landing_spread_m"][1].get<double>() > 0.0);
}

TEST_CASE("each friction of the range comes down on the spoon as it left the hood") {
  const Design design = parse_design(transfer(), "d.yaml");
  const Track track = solve(design);
  double before = 1e9;
  for (const LevelRide& ride : track.rides()) {
    Body body = body_of(design);
    body.friction = ride.motion->body().friction;
    const HoodPassage passage = hood_passage(design, body);
    CHECK(ride.motion->body().landing->speed == passage.landing.speed);
    CHECK(
        ride.motion->body().entry_speed ==
        speed_after(passage.landing, Angle::from_radians(track.centerline->slope_angle(0.0)), body.friction));
    CHECK(ride.motion->exit_speed() < before);
    before = ride.motion->exit_speed();
  }
  bool judged = false;
  for (const Judgement& one : judge_rules(design, track)) {
    if (one.rule.id != "chute.5.hood") continue;
    judged = true;
    CHECK(one.verdict == RuleVerdict::pass);
    CHECK_THAT(one.place, Contains("hood, high friction"));
  }
  CHECK(judged);
}

TEST_CASE("what is left to choose is chosen no worse than any hood tried, and a wider choice is no slower") {
  const auto with_radius = [](const std::string& radius) {
    return transfer("hood: {radius: " + radius +
                    ", impact_angle: 12 deg, exit_angle: 78 deg, drop: 400 mm}\n");
  };
  const auto time_of = [](const std::string& text) {
    const Design design = parse_design(text, "d.yaml");
    const Track track = solve(design);
    return transfer_time(as_solved(design, track), track.motion);
  };
  const double chosen = time_of(with_radius("{lowest: 0.6 m, highest: 1.1 m}"));
  for (const char* const radius : {"0.6 m", "0.7 m", "0.85 m", "1 m", "1.1 m"}) {
    INFO(radius);
    CHECK(chosen <= time_of(with_radius(radius)) * (1.0 + 1e-6));
  }
  CHECK(time_of(with_radius("{lowest: 0.5 m, highest: 1.2 m}")) <= chosen * (1.0 + 1e-5));
}

TEST_CASE("hood and spoon are found together within limits") {
  const std::string limits =
      "limits: {concave: true, smallest_valley_radius: 1 m, lowest_slope_margin: 5 deg, match_belt: {speed: "
      "3 m/s, "
      "within: 20 %}}\n";
  const Design design =
      parse_design(transfer("hood: {radius: {lowest: 0.7 m, highest: 1.1 m}, drop: 400 mm}\n", limits,
                            "centerline: {kind: fastest}\n"),
                   "d.yaml");
  const Track track = solve(design);
  REQUIRE(track.hood);
  CHECK(track.hood->settled());
  CHECK_FALSE(ride_problem(design, track));
  CHECK_FALSE(limits_problem(design, track));
  // At that hood nothing else is found.
  const Track again = solve(as_solved(design, track));
  CHECK(again.motion.travel_time() == track.motion.travel_time());
  CHECK(again.hood == track.hood);
  // The same track at another friction, and another track below the same hood, know it too.
  CHECK_NOTHROW(
      track_json(design, ride_at(as_solved(design, track), track.centerline, track.motion.body().friction)));
  // A design that is asked before its hood is known says so.
  CHECK_THROWS_WITH(body_of(design), Contains("something of it is still to be chosen"));
  const TempDir directory;
  write_frozen_design(directory.path() / "frozen.yaml", design, track);
  const Design frozen = read_design(directory.path() / "frozen.yaml");
  CHECK(solve(frozen).motion.travel_time() == Approx(track.motion.travel_time()).epsilon(1e-9));
}

TEST_CASE("a build makes a proven solid of the hood where the stream meets it") {
  const TempDir directory;
  const Design design =
      parse_design(transfer(kHood, "mesh: {tolerance: 1 mm}\nexport: [stl, off, scad, csv]\n"), "d.yaml");
  const Build made = build(design, directory.path());
  REQUIRE(made.parts.size() == 2);
  const Part& hood = made.parts.back();
  CHECK(hood.name == "hood");
  CHECK(hood.files == std::vector<std::string>{"d.hood.stl", "d.hood.off", "d.hood.scad"});
  for (const std::string& file : hood.files)
    CHECK(std::filesystem::file_size(directory.path() / file) > 1000);
  const ProvenSolid& solid = hood.solid.value();
  CHECK(solid.facts.watertight());
  CHECK(solid.facts.oriented_outward);
  CHECK(solid.max_deviation <= 1e-3);
  // Its underside is at the radius from the arc's centre, its plate outside of it, and it hangs over the spoon.
  const HoodPassage passage = hood_passage(design, made.track.motion.body());
  const double entry = passage.motion.centerline().slope_angle(0.0);
  const double centre_x = -passage.start.x - std::sin(entry);
  const double centre_z = passage.start.y - std::cos(entry);
  double nearest = 1e9;
  double farthest = 0.0;
  for (const Vec3& vertex : solid.solid.mesh.vertices) {
    const double radius = std::hypot(vertex.x - centre_x, vertex.z - centre_z);
    nearest = std::min(nearest, radius);
    farthest = std::max(farthest, radius);
  }
  CHECK(farthest == Approx(1.008).epsilon(1e-5));  // R and the plate's thickness
  CHECK(nearest == Approx(0.6).epsilon(1e-3));     // the walls' rims, 400 mm towards the centre
  // Pappus: the section's area times the way of its centroid.
  CHECK(solid.facts.volume == Approx(solid.solid.exact_volume).epsilon(1e-3));
}

TEST_CASE("a hood is as wide as its track at the start, whatever that is further on") {
  const TempDir directory;
  const auto volume = [&](const std::string& width) {
    std::string text = transfer(kHood, "mesh: {tolerance: 1 mm}\nexport: [off]\n");
    const std::string all = "width: 800 mm";
    text.replace(text.find(all), all.size(), width);
    return build(parse_design(text, "d.yaml"), directory.path())
        .parts.back()
        .solid.value()
        .solid.exact_volume;
  };
  CHECK(volume("width: [{at: 0 m, width: 800 mm}, {at: 1.5 m, width: 600 mm}]") == volume("width: 800 mm"));
}

TEST_CASE("a track below a hood has one stall friction, whatever the friction of its own") {
  const Design design = read_design(designs_path("ore_transfer.yaml"));
  const Track track = solve(design);
  const Body own = track.motion.body();
  REQUIRE(own.approach);
  const auto stalls = stall_friction_angle(track.centerline, own, design.gravity);
  REQUIRE(stalls);
  // Far above, the stream falls away from the hood, and what follows is no ride of this track.
  Body rubbed = own;
  rubbed.friction = Friction::from_angle(Angle::from_degrees(53.6));
  CHECK(own.approach->falls_away(rubbed));
  CHECK_FALSE(own.approach->falls_away(own));
  for (const double degrees : {10.0, 17.0, 17.02, 24.0, 31.0, 45.0, 50.0, 51.0, 53.0}) {
    CAPTURE(degrees);
    Body body = own;
    body.friction = Friction::from_angle(Angle::from_degrees(degrees));
    const auto found = stall_friction_angle(track.centerline, body, design.gravity);
    REQUIRE(found);
    CHECK(found->radians() == Approx(stalls->radians()).margin(kStallFrictionAccuracy));
  }
}

TEST_CASE("a hood keeps clear of what the track keeps clear of") {
  const auto beam = [](double x, double z) {
    const auto at = [&](double dx, double dz) {
      return "[" + std::to_string(x + dx) + " m, " + std::to_string(z + dz) + " m]";
    };
    return "limits: {keep_outs: [{outline: [" + at(0, 0) + ", " + at(0.1, 0) + ", " + at(0.1, 0.1) + ", " +
           at(0, 0.1) + "]}]}\n";
  };
  const Design design = parse_design(transfer(), "d.yaml");
  const HoodPassage passage = hood_passage(design, body_of(design));
  const CenterlinePoint middle = passage.motion.centerline().at(0.5 * passage.motion.centerline().length());
  const double x = middle.x - passage.start.x;
  const double z = 3.0 + passage.start.y - middle.drop;
  CHECK_THROWS_WITH(solve(parse_design(transfer(kHood, beam(x, z)), "d.yaml")),
                    Contains("the hood breaks keep_outs[0]: it reaches in by"));
  // Far outside of the arc it is in nobody's way.
  CHECK_NOTHROW(solve(parse_design(transfer(kHood, beam(x + 1.5, z + 1.0)), "d.yaml")));
}

TEST_CASE("no hood: each with place, value, bound and way out") {
  const std::string no_contact =
      problems(transfer("hood: {radius: 3 m, impact_angle: 5 deg, exit_angle: 80 deg, drop: 400 mm}\n"));
  CHECK_THAT(no_contact, Contains("no contact where the feed meets it: v^2/(g R) is 0."));
  CHECK_THAT(no_contact, Contains("a radius below 1."));
  CHECK_THAT(problems(transfer("hood: {drop: 400 mm}\n")), Contains("radius"));
  CHECK_THAT(problems(transfer("hood: {radius: 1 m, drop: 0 m}\n")), Contains("drop: 0 mm is out of range"));
  CHECK_THAT(problems(transfer("hood: {radius: 1 m, exit_angle: 20 deg, drop: 400 mm}\n")),
             Contains("but the stream meets the hood at"));
  CHECK_THAT(problems(transfer("hood: {radius: {lowest: 1 m, highest: 0.7 m}, drop: 400 mm}\n")),
             Contains("radius: lowest, 1 m, is above highest, 700 mm"));
  CHECK_THAT(problems(transfer("hood: {radius: {lowest: 1 m}, drop: 400 mm}\n")), Contains("highest"));
  std::string hopper = transfer();
  const std::string belt = "feed: {kind: belt, belt_speed: 3.6 m/s, pulley_radius: 400 mm, drop: 200 mm}\n";
  hopper.replace(hopper.find(belt), belt.size(), "feed: {kind: hopper, drop: 1 m}\n");
  CHECK_THAT(problems(hopper), Contains("hood: without a feed from a belt"));
}

TEST_CASE("where some of a choice has no contact, what is chosen has") {
  const Design design = parse_design(transfer("hood: {radius: {lowest: 0.9 m, highest: 4 m}, impact_angle: "
                                              "12 deg, exit_angle: 78 deg, drop: 400 mm}\n"),
                                     "d.yaml");
  const Track track = solve(design);
  REQUIRE(track.hood);
  for (const LevelRide& ride : track.rides())
    CHECK(hood_passage(as_solved(design, track), ride.motion->body()).least_contact >= 1.0);
}

namespace {

/// What a solve told, as programs read it.
json told(const Design& design, const Track& track) {
  return json::parse(track_json(design, track));
}

/// A hood that is not known to be the best is told everywhere as that.
void tells_of_early_hood(const Design& design, const Track& track, const std::string& why) {
  REQUIRE(track.early_hood);
  CHECK(track.early_hood->ended_early);
  CHECK_THAT(track.early_hood->message, Contains(why) && Contains("best hood and track so far"));
  const auto problem = search_problem(design, track);
  REQUIRE(problem);
  CHECK_THAT(problem->what, Contains("the search for the hood ended early: ") && Contains(why));
  const bool interrupted = why == "stopped";
  CHECK(track.early_hood->interrupted == interrupted);
  CHECK(problem->hint ==
        (interrupted ? "the same command, left to come to its end" : "a larger --time-budget"));
  const json document = told(design, track);
  CHECK(document["hood"]["not_converged"] == track.early_hood->message);
  if (!track.search) return;
  CHECK(track.search->ended_early);
  CHECK(document["search"]["status"] == "feasible, not converged");
  CHECK_THAT(document["search"]["message"].get<std::string>(), Contains(why));
}

}  // namespace

TEST_CASE("a transfer is told as the best one, or that its search ended early, whatever the time budget") {
  const Design design = read_design(designs_path("ore_transfer.yaml"));
  const auto solved = [&](double budget) {
    RunContext context;
    context.time_budget = budget;
    return solve(design, context);
  };
  const auto time_of = [&](const Track& track) {
    return transfer_time(as_solved(design, track), track.motion);
  };
  const Track whole = solved(60.0);
  CHECK_FALSE(search_problem(design, whole));
  CHECK(told(design, whole)["hood"]["not_converged"].is_null());
  int early = 0;
  for (const double budget : {1e-3, 0.02, 0.05, 0.1, 0.2, 0.5}) {
    CAPTURE(budget);
    const Track track = solved(budget);
    CHECK_FALSE(limits_problem(design, track));
    if (!search_problem(design, track)) {
      CHECK(time_of(track) == Approx(time_of(whole)).epsilon(1e-9));
      continue;
    }
    ++early;
    CHECK(time_of(track) >= time_of(whole) * (1.0 - 1e-5));
    tells_of_early_hood(design, track, "the time budget ran out");
  }
  CHECK(early > 0);
}

TEST_CASE("a request to stop while the hood is chosen is met with the best hood and track so far") {
  const Design design = read_design(designs_path("ore_transfer.yaml"));
  double before = std::numeric_limits<double>::infinity();
  for (const int tries : {2, 4, 8, 12}) {
    CAPTURE(tries);
    std::stop_source source;
    std::atomic<bool> goes_on = false;
    RunContext context;
    context.stop = source.get_token();
    context.goes_on_after_stop = &goes_on;
    context.progress = [&](std::string_view stage, std::optional<double>) {
      if (stage != "choosing the hood, try " + std::to_string(tries)) return;
      // Work that is asked to end here may take its time over it.
      CHECK(goes_on);
      source.request_stop();
    };
    const Track track = solve(design, context);
    REQUIRE(source.stop_requested());
    CHECK(goes_on);
    CHECK_FALSE(limits_problem(design, track));
    tells_of_early_hood(design, track, "stopped");
    const double time = transfer_time(as_solved(design, track), track.motion);
    CHECK(time <= before * (1.0 + 1e-9));
    before = time;
  }
}

TEST_CASE(
    "a hood above a drawn track that was not chosen to the end is told, though no track was searched for") {
  const Design design =
      parse_design(transfer("hood: {radius: {lowest: 0.6 m, highest: 1.1 m}, drop: 400 mm}\n"), "d.yaml");
  RunContext context;
  context.time_budget = 1e-9;
  const Track track = solve(design, context);
  CHECK_FALSE(track.search);
  tells_of_early_hood(design, track, "the time budget ran out");
  CHECK_FALSE(search_problem(design, solve(design)));
}

TEST_CASE("no hood found in time is no word on those that were not looked at") {
  // In the middle of the choice no hood has contact, nearer to its lowest radius all have.
  const Design design = parse_design(
      transfer("hood: {radius: {lowest: 0.9 m, highest: 4 m}, impact_angle: 12 deg, exit_angle: 78 deg, "
               "drop: 400 mm}\n"),
      "d.yaml");
  CHECK_NOTHROW(solve(design));
  RunContext context;
  context.time_budget = 1e-9;
  try {
    static_cast<void>(solve(design, context));
    FAIL("solved in no time");
  } catch (const NoTrackFound& none) {
    CHECK_THAT(none.what(),
               Contains("d.yaml:6:1: ended early, before any hood led the stream to the finish") &&
                   Contains("Try: a larger --time-budget"));
    CHECK(none.report().ended_early);
    CHECK_NOTHROW(conflict_json(design, none.report()));
  }
  std::stop_source source;
  source.request_stop();
  context.stop = source.get_token();
  CHECK_THROWS_AS(solve(design, context), Interrupted);
}

TEST_CASE("a hood is written back as it was read") {
  for (const char* const hood :
       {"hood: {radius: 1.1 m, impact_angle: 12 deg, exit_angle: 78 deg, drop: 400 mm}\n",
        "hood: {radius: {lowest: 0.7 m, highest: 1.1 m}, impact_angle: {lowest: 5 deg, highest: 15 deg}, "
        "exit_angle: "
        "{lowest: 70 deg, highest: 88 deg}, drop: 0.4 m}\n"}) {
    const Design design = parse_design(transfer(hood), "d.yaml");
    CHECK(parse_design(design_text(design), "d.yaml").asks_the_same(design));
  }
}

}  // namespace hood_test
