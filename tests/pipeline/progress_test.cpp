#include "glissade/core/error.hpp"
#include "glissade/pipeline.hpp"
#include "glissade/pipeline/json.hpp"

#include "pipeline/build/fabricate.hpp"
#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

using namespace glissade;

TEST_CASE("the progress of a build goes on from its search to its files") {
  const TempDir place;
  const Design design = read_design(designs_path("ski_jump_inrun_with_limits.yaml"));
  std::vector<double> fractions;
  RunContext context;
  context.progress = [&](std::string_view, std::optional<double> fraction) {
    if (fraction) fractions.push_back(*fraction);
  };
  static_cast<void>(build(design, place.path(), context));
  REQUIRE(fractions.size() > 5);
  CHECK(fractions.front() == 0.0);
  CHECK(std::is_sorted(fractions.begin(), fractions.end()));
  CHECK(fractions.back() < 1.0);
}

TEST_CASE("a request to stop is met by a search, and ends a build that is past it") {
  const auto built_when = [](const TempDir& place, std::string_view asked, const std::string& objective) {
    const Design design = parse_design(
        "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}\n"
        "body: {friction_coefficient: 0.2}\nlimits: {smallest_radius: 3 m, objective: " +
            objective + "}\nexport: [csv]\n",
        "track.yaml");
    std::stop_source source;
    RunContext context;
    context.stop = source.get_token();
    context.progress = [&, asked](std::string_view stage, std::optional<double>) {
      if (stage == asked) source.request_stop();
    };
    return build(design, place.path(), context);
  };
  for (const char* const objective : {"travel_time", "least_wear"}) {
    for (const char* const step : {"finer track", "referee", "prices"}) {
      INFO(objective << ", " << step);
      const TempDir place;
      const Build early = built_when(place, step, objective);
      REQUIRE(early.track.search);
      CHECK(early.track.search->ended_early);
      CHECK(early.track.search->status == OptimizeStatus::feasible_not_converged);
      CHECK_FALSE(std::filesystem::is_empty(place.path()));
      // What wears least is not held against a fastest track that nothing looked for.
      CHECK_FALSE(early.track.fastest_within);
    }
  }
  const TempDir other;
  try {
    static_cast<void>(built_when(other, "riding the track", "travel_time"));
    FAIL("built to its end");
  } catch (const Interrupted& error) {
    CHECK(std::string(error.what()).find("interrupted after the search") != std::string::npos);
  }
  CHECK(std::filesystem::is_empty(other.path()));
}

TEST_CASE("a request to stop ends the printing of parts") {
  const Design design = read_design(designs_path("marble_run_printed.yaml"));
  const Track track = solve(design);
  std::stop_source source;
  CHECK_NOTHROW(pipeline::fabricate(design, track, track.placement, source.get_token()));
  source.request_stop();
  CHECK_THROWS_AS(pipeline::fabricate(design, track, track.placement, source.get_token()), Interrupted);
}

TEST_CASE("a request to stop that comes in the search that a result is held against is told of the result") {
  const Design design = parse_design(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0.2}\nlimits: {smallest_radius: 3 m, objective: least_wear}\n",
      "track.yaml");
  const Track whole = solve(design);
  REQUIRE(whole.fastest_within);
  for (const char* const step : {"coarse track", "prices"}) {
    INFO(step);
    std::stop_source source;
    bool second = false;
    RunContext context;
    context.stop = source.get_token();
    context.progress = [&](std::string_view stage, std::optional<double>) {
      if (stage == "riding the track") second = true;
      if (second && stage == step) source.request_stop();
    };
    const Track early = solve(design, context);
    CHECK(source.stop_requested());
    REQUIRE(early.search);
    CHECK(early.search->ended_early);
    CHECK(search_problem(design, early));
    CHECK_FALSE(early.fastest_within);
    CHECK(early.motion.travel_time() == whole.motion.travel_time());
  }
}

TEST_CASE("a design without a cross-section that exports csv alone is built: stations and report") {
  const TempDir place;
  const Design design = parse_design(
      "glissade: 1\ntrack: {start: {x: 0 m, z: 5 m}, finish: {x: 10 m, z: 0 m}}\n"
      "body: {friction_coefficient: 0.2}\nexport: [csv]\n",
      "track.yaml");
  const Build built = build(design, place.path());
  REQUIRE(built.files.size() == 2);
  CHECK_FALSE(built.has_solid());
  CHECK(built.files[0].path.filename() == "track.csv");
  CHECK(bytes_of(built.files[0].path).find("arc_length_m") != std::string::npos);
  CHECK(bytes_of(built.files[1].path).find("</html>") != std::string::npos);
  CHECK(built.parts.empty());
  CHECK(nlohmann::json::parse(build_json(design, built)).at("mesh").is_null());
  const TempDir again;
  const Build plain = build(design, again.path(), {}, {.report = false});
  CHECK(bytes_of(plain.files.at(0).path) == bytes_of(built.files[0].path));
}

TEST_CASE("a build tells each step and what part of the work is done, from none to less than all") {
  const TempDir place;
  const Design design =
      read_design(designs_path("powder_chute.yaml"), {{"export", "[stl, stl-ascii, off, scad, csv]"}});
  std::vector<std::string> stages;
  std::vector<std::optional<double>> fractions;
  RunContext context;
  context.progress = [&](std::string_view stage, std::optional<double> fraction) {
    stages.emplace_back(stage);
    fractions.push_back(fraction);
  };
  const Build built = build(design, place.path(), context);
  REQUIRE(built.files.size() == 6);

  REQUIRE(stages.size() > 8);
  CHECK(stages[0] == "finding the track");
  CHECK_FALSE(fractions[0].has_value());  // not known
  CHECK(stages[1] == "making the mesh");
  CHECK(fractions[1] == 0.0);
  for (std::size_t index = 2; index < stages.size(); ++index) {
    INFO(stages[index]);
    CHECK(fractions[index] > fractions[index - 1]);
    CHECK(*fractions[index] < 1.0);
  }
  CHECK(stages.back().ends_with(".report.html"));
}
