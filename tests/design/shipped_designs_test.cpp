#include "glissade/design/design.hpp"
#include "glissade/design/template.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

#include <cmath>
#include <filesystem>
#include <set>
#include <string>

using namespace glissade;

TEST_CASE("every design in designs/ is sound") {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(designs_path())) {
    if (entry.path().extension() != ".yaml") continue;
    INFO(entry.path().filename().string());
    const Design design = read_design(entry.path());
    CHECK(check(design).empty());
    CHECK(design.cross_section.has_value());
    CHECK_FALSE(design.name.empty());
    names.insert(entry.path().stem().string());
  }
  for (const char* name :
       {"grain_chute", "ski_jump_inrun", "sand_ski_ramp", "toboggan_run", "powder_chute",
        "pudasaini_figure_1", "marble_run", "ski_jump_inrun_with_limits", "grain_chute_with_limits",
        "toboggan_on_terrain", "wood_chip_chute", "ski_jump_inrun_track", "grain_chute_with_stream",
        "ore_transfer", "powder_chute_with_stream", "toboggan_run_with_mats"}) {
    CHECK(names.contains(name));
  }
}

TEST_CASE("the in-run has the run, drop and friction of a large hill") {
  const Design design = read_design(designs_path("ski_jump_inrun.yaml"));
  CHECK(design.track.finish.x - design.track.start.x == 83.48);
  CHECK(design.track.start.z - design.track.finish.z == 45.79);
  CHECK(design.body.friction.coefficient() == 0.03);
}

TEST_CASE("figure 1's seven friction angles can all be set on its design") {
  for (const char* angle : {"11 deg", "13 deg", "15 deg", "17 deg", "20 deg", "25 deg", "40 deg"}) {
    const Design design =
        read_design(designs_path("pudasaini_figure_1.yaml"), {{"body.friction_angle", angle}});
    REQUIRE(design.centerline.constant_speed_p.has_value());
    CHECK(*design.centerline.constant_speed_p == 100.0);
  }
}

TEST_CASE("every template is a sound design") {
  REQUIRE_FALSE(design_templates().empty());
  CHECK(design_templates().front().kind == "chute");
  for (const DesignTemplate& entry : design_templates()) {
    INFO(entry.kind);
    const std::string text = design_template(entry.kind);
    CHECK_NOTHROW(parse_design(text, "design.yaml"));
    CHECK(text.find('\t') == std::string::npos);
    CHECK_FALSE(entry.summary.empty());
  }
  CHECK(parse_design(design_template("points"), "design.yaml").centerline.points_file ==
        kTemplateProfileName);
}

TEST_CASE("a template that there is not is refused with those that there are") {
  CHECK_THROWS_AS(design_template("chut"), InputError);
  CHECK_THROWS_WITH(design_template("chut"), Catch::Matchers::Contains("chute, ramp, toboggan") &&
                                                 Catch::Matchers::EndsWith("Try: chute"));
}

TEST_CASE("every kind has a word, and the word names the kind") {
  for (const CenterlineKind kind : centerline_kinds()) CHECK(centerline_kind(word(kind)) == kind);
  CHECK_FALSE(centerline_kind("quickest").has_value());
  CHECK(section::kind(section::HalfPipe()) == "half-pipe");
  CHECK(word(ExportFormat::stl_ascii) == "stl-ascii");
}
