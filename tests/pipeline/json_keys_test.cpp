// A design whose limits no track keeps has the keys of one that has a track, so that a reader asks only for values.

#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "pipeline/track_document.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <set>
#include <string>

#include <nlohmann/json.hpp>

namespace json_keys_test {

using namespace glissade;
using nlohmann::json;

namespace {

std::set<std::string> keys_of(const std::string& document) {
  std::set<std::string> keys;
  const json parsed = json::parse(document);
  for (const auto& [key, value] : parsed.items()) keys.insert(key);
  return keys;
}

std::string document_of(const std::string& text) {
  const Design design = parse_design(text, "d.yaml");
  try {
    return track_json(design, solve(design));
  } catch (const LimitsConflict& conflict) {
    return conflict_json(design, conflict.report());
  } catch (const NoTrackFound& none) {
    return conflict_json(design, none.report());
  }
}

/// The rest of a design of which only limits differ.
std::string with_limits(const std::string& rest, const std::string& limits) {
  return "glissade: 1\nlimits: {" + limits + "}\ncenterline: {kind: fastest}\n" + rest;
}

constexpr const char* kEnds = "track: {start: {x: 0 m, z: 3 m}, finish: {x: 2 m, z: 0.6 m}}\n";
constexpr const char* kSection =
    "cross_section: {kind: u-channel, width: 600 mm, wall_height: 400 mm, thickness: 8 mm}\n";
constexpr const char* kStream = "stream: {mass_flow: 100 t/h, bulk_density: 1600 kg/m^3}\n";
constexpr const char* kEntering = "body: {friction_angle: 27 deg, entry_speed: 2 m/s}\n";

}  // namespace

TEST_CASE("a design without a track has all keys of one that has one") {
  const std::string ends = kEnds;
  const std::string falling =
      ends + kSection + kStream + "body: {friction_angle: {low: 25 deg, nominal: 27 deg, high: 28 deg}}\n";
  const std::string belt = "feed: {kind: belt, belt_speed: 3.2 m/s, pulley_radius: 400 mm, drop: 150 mm}\n";
  const std::string hood =
      "hood: {radius: 0.9 m, impact_angle: 15 deg, exit_angle: 80 deg, drop: 300 mm}\n"
      "discharge: {belt_speed: 3 m/s, drop: 300 mm}\n";
  int number = 0;
  for (const std::string& rest :
       {ends + "body: {friction_angle: 20 deg}\n", ends + "body: {friction_angle: 20 deg, drag: 0.01 1/m}\n",
        ends + "body: {kind: rolling, radius: 8 mm, rolling_resistance: 0.01}\n",
        ends + "body: {friction_angle: 20 deg, centre_height: 50 mm}\n",
        ends + "body: {friction_angle: {low: 18 deg, nominal: 20 deg, high: 22 deg}}\nname: n\n",
        ends + kSection + kStream + kEntering, falling + "feed: {kind: free-fall, drop: 1 m}\n",
        falling + belt + hood}) {
    INFO(rest);
    // A ball with one friction, and a stream with a hood over a range; sliding bodies of other kinds in CI.
    const int kind = number++;
    if (kind != 2 && kind != 7 && !testing::thorough()) continue;
    const std::string with = document_of(with_limits(rest, "smallest_valley_radius: 0.5 m, concave: true"));
    const std::string without = document_of(with_limits(rest, "speed: {highest: 2.1 m/s}"));
    REQUIRE(json::parse(with)["status"] == "arrived");
    REQUIRE(json::parse(without)["travel_time_s"].is_null());
    CHECK(keys_of(with) == keys_of(without));
  }
}

// What warnings look for, such as room for the section along the track, takes longer than all else that a row of a sweep needs.
TEST_CASE("figures of a track alone are its numbers, without what warnings and rules have to say") {
  const std::string text =
      std::string("glissade: 1\n") + kEnds + kSection + kStream +
      "body: {friction_angle: {low: 25 deg, nominal: 27 deg, high: 28 deg}, entry_speed: 2 m/s}\n"
      "centerline: {kind: straight}\n"
      "probes: [{x: 50 m}]\nrules: {sets: [chute]}\n";
  const Design design = parse_design(text, "d.yaml");
  const Track track = solve(design);
  auto whole = pipeline::track_document(design, track);
  auto figures = pipeline::track_document(design, track, pipeline::Told::figures_and_stall_margin);
  REQUIRE_FALSE(whole["warnings"].empty());
  REQUIRE_FALSE(whole["rules"].empty());
  for (const char* const key : {"warnings", "rules", "verdicts", "cases"}) {
    CHECK(figures[key].is_array());
    CHECK(figures[key].empty());
    whole.erase(key);
    figures.erase(key);
  }
  CHECK(figures == whole);
}

}  // namespace json_keys_test
