#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/motion/motion.hpp"

#include "cli/glissade.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/random.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include <nlohmann/json.hpp>

namespace solve_test {

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

/// Digits enough to come back as the same double.
std::string digits(double value) {
  return json(value).dump();
}

/// The reference files hold numbers as text.
double value_of(const json& text) {
  return std::stod(text.get<std::string>());
}

json solved(const std::vector<std::string>& arguments) {
  std::vector<std::string> all = {"solve", "--json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const Outcome outcome = glissade_run(all);
  INFO(outcome.errors);
  REQUIRE(outcome.exit_code == 0);
  return json::parse(outcome.output);
}

double relative(double value, double expected) {
  return std::fabs(value - expected) / std::fabs(expected);
}

}  // namespace

TEST_CASE("solve --json with an entry speed gives the reference values") {
  std::ifstream stream(test_data_path("reference/entry_speed.json"));
  for (const json& expected : json::parse(stream)) {
    const auto input = [&](const char* name) { return digits(value_of(expected[name])); };
    const json track = solved({"--run", input("run"), "--drop", input("drop"), "--friction-coefficient",
                               input("friction_coefficient"), "--gravity", input("gravity"), "--entry-speed",
                               input("entry_speed")});
    CHECK(relative(track["travel_time_s"], value_of(expected["travel_time"])) <= glissade::kMotionAccuracy);
    CHECK(relative(track["optimum_travel_time_s"], value_of(expected["travel_time"])) <= 1e-12);
    CHECK(relative(track["exit_speed_m_per_s"], value_of(expected["exit_speed"])) <=
          glissade::kMotionAccuracy);
  }
}

TEST_CASE("what is called fastest is never slower than the straight line") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int compared = 0;
  const int count = testing::thorough() ? 60 : 12;
  for (int i = 0; i < count; ++i) {
    const double mu = random.between(0.0, 0.6);
    const double run = random.between(1.0, 50.0);
    const double speed = i % 3 == 0 ? 0.0 : random.between(0.5, 15.0);
    const double drag = i % 2 == 0 ? 0.0 : random.between(0.001, 0.05) / run;
    const double drop = run * (mu + random.between(0.05, 1.0));
    const std::vector<std::string> arguments = {
        "--run",    digits(run),     "--drop",      digits(drop), "--friction-coefficient",
        digits(mu), "--entry-speed", digits(speed), "--drag",     digits(drag)};
    INFO(json(arguments).dump());
    const json track = solved(arguments);
    if (track["straight_travel_time_s"].is_null()) continue;
    CHECK(track["travel_time_s"].get<double>() <=
          track["straight_travel_time_s"].get<double>() * (1.0 + 1e-9));
    ++compared;
  }
  CHECK(compared > count * 2 / 3);
}

TEST_CASE("solve with an entry speed that cannot reach the finish names the speed that could") {
  const Outcome outcome = glissade_run(
      {"solve", "--run", "10", "--drop", "-2", "--friction-coefficient", "0.2", "--entry-speed", "6.5"});
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("--entry-speed") && Contains("6.5 m/s is not more than the 8.") &&
                                 Contains("an entry_speed of at least 8."));
}

TEST_CASE("solve --json of the fastest track gives the reference values") {
  // tests/reference: every value exact to the printed digits.
  std::ifstream stream(test_data_path("reference/coulomb_brachistochrone.json"));
  const json cases = json::parse(stream);
  REQUIRE(cases.size() == 120);
  // A program start each: every fifth is enough here, the library's own tests take all of them.
  for (std::size_t index = 0; index < cases.size(); index += 5) {
    const json& expected = cases[index];
    const auto input = [&](const char* name) { return digits(value_of(expected[name])); };
    const json track = solved({"--run", input("run"), "--drop", input("drop"), "--friction-coefficient",
                               input("friction_coefficient"), "--gravity", input("gravity")});
    const double mu = value_of(expected["friction_coefficient"]);
    const double run = value_of(expected["run"]);
    const double gravity = value_of(expected["gravity"]);
    const double speed = value_of(expected["exit_speed"]);
    const double closed_form = glissade::coulomb_accuracy(value_of(expected["drop"]) / (mu * run) - 1.0);
    const double referee = closed_form + glissade::kMotionAccuracy;
    // A curve by arc length carries the position to `slip`. Slope and speed change with position at the rates
    // kappa and (g + kappa u^2)(1 + mu) / u, which are large on the short upturned tail near the reach limit.
    const double slip =
        glissade::CoulombBrachistochrone::kPositionAccuracy * track["arc_length_m"].get<double>();
    const glissade::CoulombSolution solution = glissade::solve_coulomb_brachistochrone(
        {run, value_of(expected["drop"])}, glissade::Friction::from_coefficient(mu), gravity);
    const double curvature = solution.at_slope_angle(solution.exit_slope_angle).curvature;
    const double speed_slip = slip * (gravity + curvature * speed * speed) * (1.0 + mu) / (speed * speed);
    INFO(expected.dump());
    CHECK(relative(track["optimum_travel_time_s"], value_of(expected["travel_time"])) <= closed_form);
    CHECK(relative(track["travel_time_s"], value_of(expected["travel_time"])) <= referee);
    CHECK(relative(track["exit_speed_m_per_s"], speed) <= referee + speed_slip);
    CHECK(relative(track["straight_travel_time_s"], value_of(expected["straight_time"])) <= referee);
    const double exit_slope = track["exit_slope_angle_deg"].get<double>() * (std::numbers::pi / 180.0);
    CHECK(std::fabs(exit_slope - value_of(expected["exit_slope_angle"])) <= closed_form + curvature * slip);
  }
}

TEST_CASE("solve takes plain SI numbers and values with a unit alike") {
  const json plain = solved({"--run", "10", "--drop", "5", "--friction-coefficient", "0.2"});
  const json united = solved({"--run", "10 m", "--drop", "5000mm", "--friction-coefficient", "0.2"});
  CHECK(plain == united);
}

TEST_CASE("a finish on the left is the mirror image: the same ride") {
  const json right = solved({"--run", "10", "--drop", "5", "--friction-angle", "11deg"});
  const json left = solved({"--run", "-10", "--drop", "5", "--friction-angle", "11deg"});
  CHECK(left == right);
}

TEST_CASE("solve --json: theory's travel times at friction 0.2 over 10 m and 5 m") {
  // docs/theory.md, table of travel times: exact optimum and straight line.
  const json track = solved({"--run", "10", "--drop", "5", "--friction-coefficient", "0.2"});
  CHECK(relative(track["travel_time_s"], 2.14712546857048) < 1e-10);
  CHECK(relative(track["optimum_travel_time_s"], 2.14712546857048) < 1e-12);
  CHECK(track["straight_travel_time_s"].get<double>() == Approx(2.91457).epsilon(2e-6));
  CHECK(track["status"] == "arrived");
  CHECK(track["entry_slope_angle_deg"].get<double>() == Approx(90.0));
  CHECK(track["min_radius_m"] == 0.0);
  CHECK(track["stall"].is_null());
}

TEST_CASE("solve --json: a constant-speed track by its P") {
  // docs/theory.md, table of travel times: 2.19868 s at P = 127.
  const json track = solved({"--run", "10", "--drop", "5", "--friction-coefficient", "0.2", "--p", "127"});
  CHECK(track["centerline"] == "constant-speed");
  CHECK(track["travel_time_s"].get<double>() == Approx(2.19868).epsilon(1e-5));
  CHECK(track["travel_time_s"].get<double>() > track["optimum_travel_time_s"].get<double>());
  CHECK(track["constant_speed"]["p_m2_per_s2"] == 127.0);
  CHECK(track["constant_speed"]["speed_m_per_s"] == std::sqrt(127.0));
  CHECK(relative(track["constant_speed"]["travel_time_at_that_speed_s"],
                 track["arc_length_m"].get<double>() / std::sqrt(127.0)) < 1e-12);
}

TEST_CASE("without a P, the one that is fastest is told") {
  const std::vector<std::string> task = {
      "--run", "10", "--drop", "5", "--friction-coefficient", "0.2", "--centerline", "constant-speed"};
  const json best = solved(task);
  const double p = best["constant_speed"]["p_m2_per_s2"];
  for (const double other : {0.99 * p, 1.01 * p}) {
    std::vector<std::string> with_p = task;
    with_p.insert(with_p.end(), {"--p", digits(other)});
    CHECK(solved(with_p)["travel_time_s"] > best["travel_time_s"]);
  }
  std::vector<std::string> summary = {"solve"};
  summary.insert(summary.end(), task.begin(), task.end());
  CHECK_THAT(glissade_run(summary).output, Contains("Pudasaini's curve, P ") && Contains(" m^2/s^2"));
}

TEST_CASE("with drag no speed of a constant-speed track is told as kept, and P is that of the ride") {
  std::vector<std::string> task = {"--run", "10", "--drop", "5", "--friction-coefficient", "0.2"};
  task.insert(task.end(), {"--centerline", "constant-speed", "--drag", "0.1", "--entry-speed", "3"});
  const json best = solved(task);
  CHECK(best["travel_time_s"].get<double>() == Approx(2.50009).epsilon(1e-5));
  CHECK(best["constant_speed"]["p_m2_per_s2"].get<double>() == Approx(331.168).epsilon(1e-4));
  CHECK(best["constant_speed"]["speed_m_per_s"].is_null());
  CHECK(best["constant_speed"]["travel_time_at_that_speed_s"].is_null());
  std::vector<std::string> summary = {"solve"};
  summary.insert(summary.end(), task.begin(), task.end());
  CHECK_THAT(
      glissade_run(summary).output,
      Contains("without drag a body fed at 18.2 m/s would keep that speed") && !Contains("keeps that"));
  summary = {"solve", "--run", "10", "--drop", "5", "--friction-coefficient", "0.2", "--p", "127"};
  CHECK_THAT(glissade_run(summary).output, Contains("a body fed at 11.27 m/s keeps that speed, for "));
  // A crest that begins so that nothing stays on it.
  summary = {"solve", "--run", "10", "--drop", "1", "--friction-coefficient", "0.3", "--p", "60"};
  summary.insert(summary.end(), {"--entry-speed", "7.745967"});
  const Outcome crest = glissade_run(summary);
  CHECK_THAT(crest.output, Contains("leaves the track") && !Contains("keeps that speed"));
}

TEST_CASE("a load without bound is called so, and is null in --json") {
  // The cycloid starts with unbounded curvature; whoever enters it with speed meets an unbounded load.
  const std::vector<std::string> task = {"--run",         "10", "--drop", "5", "--friction-angle", "11deg",
                                         "--entry-speed", "5"};
  std::vector<std::string> cycloid = task;
  cycloid.insert(cycloid.end(), {"--centerline", "cycloid"});
  CHECK(solved(cycloid)["max_normal_load_m_per_s2"].is_null());
  for (const std::string command : {"solve", "compare"}) {
    const std::vector<std::string>& asked = command == "solve" ? cycloid : task;
    std::vector<std::string> all = {command};
    all.insert(all.end(), asked.begin(), asked.end());
    const Outcome outcome = glissade_run(all);
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.output, Contains("unbounded") && !Contains("inf "));
  }
}

TEST_CASE("the fastest track leads uphill, curves made for a start from rest do not and say so") {
  std::vector<std::string> task = {"--run",         "10", "--drop", "-1", "--friction-angle", "11deg",
                                   "--entry-speed", "20"};
  CHECK(solved(task)["travel_time_s"].get<double>() < 0.6);
  task.insert(task.begin(), "solve");
  task.insert(task.end(), {"--centerline", "cycloid"});
  const Outcome outcome = glissade_run(task);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.errors, Contains("--drop: the finish lies 1 m above the start") &&
                                 Contains("start from rest") && Contains("Try: kind: fastest"));
}

TEST_CASE("solve --json: the straight ramp has its closed form, no curvature and the load g cos") {
  const json track =
      solved({"--run", "12", "--drop", "5", "--friction-coefficient", "0.1", "--centerline", "straight"});
  const double pull = 9.81 * (5.0 / 13.0 - 0.1 * 12.0 / 13.0);
  CHECK(relative(track["travel_time_s"], std::sqrt(2.0 * 13.0 / pull)) < 1e-12);
  CHECK(relative(track["exit_speed_m_per_s"], std::sqrt(2.0 * 13.0 * pull)) < 1e-12);
  CHECK(relative(track["max_normal_load_m_per_s2"], 9.81 * 12.0 / 13.0) < 1e-12);
  CHECK(track["arc_length_m"] == 13.0);
  CHECK(track["min_radius_m"].is_null());
  CHECK(track["exit_slope_angle_deg"].get<double>() ==
        Approx(std::atan2(5.0, 12.0) * 180.0 / std::numbers::pi));
}

TEST_CASE("numbers of --json read back to the same double") {
  const json track = solved({"--run", digits(1.0 / 3.0), "--drop", digits(0.1 + 0.2),
                             "--friction-coefficient", digits(std::tan(0.3))});
  CHECK(track["run_m"].get<double>() == 1.0 / 3.0);
  CHECK(track["drop_m"].get<double>() == 0.1 + 0.2);
  CHECK(track["friction_coefficient"].get<double>() == std::tan(0.3));
}

TEST_CASE("friction steeper than the mean slope is infeasible, and the message gives the theorem") {
  const Outcome outcome = glissade_run({"solve", "--run", "2.5", "--drop", "2", "--friction-angle", "41deg"});
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("--friction-angle") && Contains("41 deg") && Contains("38.66 deg") &&
                                 Contains("no track between these points"));
}

TEST_CASE("a body that stalls is reported with the place and exit code 3") {
  const TempDir place;
  put_bytes(place / "dip.yaml",
            "glissade: 1\n"
            "name: Dip\n"
            "track: {start: {x: 0 m, z: 3 m}}\n"
            "body: {friction_coefficient: 0.3}\n"
            "centerline:\n"
            "  kind: segments\n"
            "  entry_slope_angle: 30 deg\n"
            "  segments: [{length: 2 m}, {length: 2 m, radius: 4 m}, {length: 20 m}]\n");
  const Outcome outcome = glissade_run({"solve", (place / "dip.yaml").string(), "--json"});
  CHECK(outcome.exit_code == 3);
  const json track = json::parse(outcome.output);
  CHECK(track["status"] == "stalled");
  CHECK(track["travel_time_s"].is_null());
  CHECK(track["stall"]["arc_length_m"].get<double>() > 2.0);
  CHECK(track["stall"]["missing_slope_deg"].get<double>() > 0.0);
  CHECK_THAT(outcome.errors, Contains("dip.yaml:") && Contains("the body stalls after ") &&
                                 Contains("less than the friction angle"));
}

TEST_CASE("the summary tells how a stream ends at each friction") {
  const TempDir place;
  put_bytes(
      place / "crest.yaml",
      "glissade: 1\n"
      "track: {start: {x: 0 m, z: 9 m}}\n"
      "body: {friction_angle: {low: 15 deg, nominal: 25 deg, high: 30 deg}, entry_speed: 2 m/s}\n"
      "stream: {mass_flow: 100 t/h, bulk_density: 800 kg/m^3}\n"
      "centerline: {kind: segments, entry_slope_angle: 40 deg, segments: [{length: 2 m}, {length: 0.5 m, "
      "radius: -3 m}]}\n"
      "cross_section: {kind: u-channel, width: 600 mm, wall_height: 400 mm, thickness: 5 mm}\n");
  const Outcome lifts = glissade_run({"solve", (place / "crest.yaml").string()});
  CHECK(lifts.exit_code == 3);
  CHECK_THAT(lifts.output, Contains("at low friction") &&
                               Contains("deep at most, leaves the track after 2.") &&
                               !Contains("deep at most, chokes"));
  put_bytes(place / "fed.yaml",
            "glissade: 1\n"
            "track: {start: {x: 0 m, z: 4 m}, finish: {x: 2 m, z: 1.5 m}}\n"
            "body: {friction_angle: {low: 25 deg, nominal: 35 deg, high: 52 deg}}\n"
            "feed: {kind: belt, belt_speed: 0.3 m/s, pulley_radius: 300 mm, drop: 1 m}\n"
            "stream: {mass_flow: 100 t/h, bulk_density: 1600 kg/m^3}\n"
            "centerline: {kind: straight}\n"
            "cross_section: {kind: u-channel, width: 800 mm, wall_height: 500 mm, thickness: 8 mm}\n");
  const Outcome stands = glissade_run({"solve", (place / "fed.yaml").string()});
  CHECK(stands.exit_code == 3);
  CHECK_THAT(stands.output, Contains("at high friction none: it stands where it lands") &&
                                !Contains("km deep") && !Contains("e-09"));
  CHECK_THAT(stands.errors,
             Contains("the feed stands where it lands") && !Contains("entry_speed") && !Contains("e-09"));
  const Outcome flies = glissade_run(
      {"solve", (place / "fed.yaml").string(), "--set", "feed.drop=0.05m", "--set", "feed.belt_speed=3m/s"});
  CHECK(flies.exit_code == 3);
  CHECK_THAT(flies.output, Contains("none: the feed flies over the start") && !Contains("Stalls from") &&
                               !Contains("never stalls") && !Contains("Normal load"));
}

TEST_CASE("what cannot be on the start of a track is told alike by every command, with place and way out") {
  const TempDir place;
  const std::string file = (place / "tight.yaml").string();
  put_bytes(place / "tight.yaml",
            "glissade: 1\n"
            "track: {start: {x: 0 m, z: 6 m}, finish: {x: 7 m, z: 1 m}}\n"
            "body: {friction_angle: 8 deg, centre_height: 0.4 m, entry_speed: 1 m/s}\n"
            "centerline: {kind: cycloid}\n");
  for (const std::string speed : {"0m/s", "1m/s"}) {
    const std::string set = "body.entry_speed=" + speed;
    for (const std::vector<std::string>& command : {std::vector<std::string>{"solve", file},
                                                    {"ride", file, "--friction-angle", "9deg"},
                                                    {"solve", file, "--json"},
                                                    {"plot", file, "-o", (place / "p.svg").string()},
                                                    {"solve", file, "--csv", (place / "t.csv").string()}}) {
      std::vector<std::string> all = command;
      all.insert(all.end(), {"--set", set});
      const Outcome outcome = glissade_run(all);
      INFO(outcome.output << outcome.errors);
      CHECK(outcome.exit_code == 3);
      CHECK_THAT(outcome.errors, Contains("tight.yaml:4:") &&
                                     Contains("cycloid: the body does not fit on the start") &&
                                     Contains("400 mm above the track") && Contains("kind: fastest"));
    }
    const Outcome compared = glissade_run({"compare", file, "--set", set});
    CHECK_THAT(compared.output, Contains("the body does not fit on the start") && !Contains("nan"));
  }
  put_bytes(place / "stream.yaml",
            "glissade: 1\n"
            "track: {start: {x: 0 m, z: 6 m}, finish: {x: 7 m, z: 1 m}}\n"
            "body: {friction_angle: 17 deg, entry_speed: 2 m/s}\n"
            "stream: {mass_flow: 60 t/h, bulk_density: 780 kg/m^3}\n"
            "centerline: {kind: cycloid}\n"
            "cross_section: {kind: u-channel, width: 400 mm, wall_height: 200 mm, thickness: 4 mm}\n");
  const Outcome stream = glissade_run({"solve", (place / "stream.yaml").string()});
  CHECK(stream.exit_code == 3);
  CHECK_THAT(stream.errors, Contains("stream.yaml:5:") && Contains("cannot enter a track whose radius is 0"));
  // Of what rides nowhere nothing is said to never stall.
  put_bytes(place / "valley.yaml",
            "glissade: 1\n"
            "track: {start: {x: 0 m, z: 6 m}}\n"
            "body: {friction_angle: 8 deg, centre_height: 0.4 m, entry_speed: 1 m/s}\n"
            "centerline: {kind: segments, entry_slope_angle: 60 deg, segments: [{length: 0.2 m, radius: 0.3 "
            "m}]}\n");
  const std::string valley = (place / "valley.yaml").string();
  const Outcome solved_there = glissade_run({"solve", valley});
  CHECK(solved_there.exit_code == 3);
  CHECK_THAT(solved_there.output,
             Contains("does not fit into the valley") && Contains("unbounded") && !Contains("Stalls from"));
  CHECK_THAT(glissade_run({"ride", valley, "--friction-angle", "9deg"}).output, !Contains("never stalls"));
}

TEST_CASE("--set replaces a value of the design file") {
  const Outcome outcome =
      glissade_run({"solve", shipped("grain_chute"), "--set", "body.friction_angle=19deg", "--json"});
  REQUIRE(outcome.exit_code == 0);
  CHECK(json::parse(outcome.output)["friction_angle_deg"].get<double>() == Approx(19.0));
}

TEST_CASE("solve --csv writes the ride by stations, at every friction, without a cross-section") {
  const TempDir place;
  const Outcome outcome =
      glissade_run({"solve", shipped("grain_chute_with_limits"), "--csv", (place / "ride.csv").string()});
  REQUIRE(outcome.exit_code == 0);
  const std::string text = bytes_of(place / "ride.csv");
  CHECK_THAT(text, StartsWith("arc_length_m,run_m,drop_m,x_m,y_m,z_m,slope_angle_deg"));
  CHECK_THAT(text, Contains("speed_low_m_per_s") && Contains("speed_high_m_per_s"));
  CHECK(std::count(text.begin(), text.end(), '\n') > 400);
}

TEST_CASE("a stall of a body that enters with speed asks for more of it") {
  const TempDir place;
  put_bytes(place / "d.yaml",
            "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}}\n"
            "body: {friction_angle: 30 deg, entry_speed: 2 m/s}\ncenterline: {kind: segments, "
            "entry_slope_angle: 20 deg, segments: [{length: 10 m}]}\n");
  const Outcome outcome = glissade_run({"solve", (place / "d.yaml").string()});
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.errors, Contains("or a higher entry_speed"));
}

TEST_CASE("a stall before the finish is told in digits that tell the two apart, or as one at the finish") {
  // Friction within a ten-millionth of the mean slope: the curve is not known well enough to arrive.
  const Outcome outcome =
      glissade_run({"solve", "--run", "9", "--drop", "6", "--friction-coefficient", "0.6666666"});
  INFO(outcome.errors);
  CHECK_THAT(outcome.errors, !Contains("10.82 m, before the finish at 10.82 m"));
  if (outcome.exit_code == 3)
    CHECK_THAT(outcome.errors, Contains("stalls all but at the finish, at 10.82 m"));
}

}  // namespace solve_test
