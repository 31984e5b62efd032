#include "glissade/pipeline.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <string>
#include <string_view>
#include <vector>

using namespace glissade;

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
