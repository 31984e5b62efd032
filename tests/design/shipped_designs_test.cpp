#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"
#include "glissade/design/template.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

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

namespace {

/// A track with all that its keys lead to but a list of frictions, each key of a body in air with a wind among them.
constexpr const char* kHill = R"(glissade: 1
track: {edge: {x: 0 m, z: 0 m}}
gravity: 9.81 m/s^2
body: {friction_coefficient: 0.03, drag_area: 0.18 m^2, mass: 75 kg, air: {altitude: 1200 m, temperature: -5 degC}, head_wind: 0.5 m/s, centre_height: 0.3 m}
centerline: {kind: in-run, gamma: 35 deg, alpha: 11 deg, r1: 103 m, t: 6.9 m, e1: 96 m, es: 24 m}
hill: {size: 142 m, construction_point: 125 m, table_height: 3.2 m, design_speed: 27 m/s}
gates: {vertical_step: 0.4 m, measuring_place: 10 m, slow: {friction_angle: 3 deg}, fast: {drag_area: 0.17 m^2, head_wind: -1 m/s}}
probes: [{from_finish: 20 m, name: a}, {from_start: 30 m}, {x: -40 m}]
)";

/// What is wrong with a design each of whose quantities with a unit, one after the other, has one that is none.
void has_one_problem_a_slip(const std::string& text, const std::filesystem::path& file) {
  static const std::regex kQuantity(R"([:\[,] -?[0-9][0-9.]* ?(%|[a-zA-Z][a-zA-Z0-9/^]*)(?=[ ,}\]\n]))");
  for (auto found = std::sregex_iterator(text.begin(), text.end(), kQuantity);
       found != std::sregex_iterator(); ++found) {
    const auto unit = static_cast<std::size_t>(found->position(1));
    const std::size_t line = text.rfind('\n', unit) + 1;
    // Neither a comment nor a name, "400 HB", "Chute, 60 t/h".
    const std::size_t key = text.rfind(':', unit);
    const bool is_name = key != std::string::npos && key >= line + 4 && text.compare(key - 4, 4, "name") == 0;
    if (text.find('#', line) < unit || is_name) continue;
    std::string slipped = text;
    slipped.replace(unit, static_cast<std::size_t>(found->length(1)), "xyz");
    INFO(file.filename().string() << ", line "
                                  << std::count(text.begin(), text.begin() + found->position(1), '\n') + 1
                                  << ":" << found->str());
    try {
      static_cast<void>(parse_design(slipped, file));
      FAIL_CHECK("read");
    } catch (const InputError& error) {
      INFO(error.what());
      CHECK(error.issues().size() == 1);
      CHECK_THAT(error.issues().front().what, Catch::Matchers::Contains("xyz"));
    }
  }
}

}  // namespace

TEST_CASE("a quantity that cannot be read is told, and nothing that would follow from it") {
  has_one_problem_a_slip(kHill, "hill.yaml");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(designs_path())) {
    if (entry.path().extension() == ".yaml") has_one_problem_a_slip(bytes_of(entry.path()), entry.path());
  }
}

TEST_CASE("a measure of a frame that cannot be read leaves the others unjudged") {
  const Design sound = read_design(designs_path("coal_chute_fabricated.yaml"));
  const std::string text = bytes_of(designs_path("coal_chute_fabricated.yaml"));
  for (const char* const slip : {"width: 80 mmm", "thickness: 8 xyz"}) {
    std::string slipped = text;
    const std::string key = std::string(slip).substr(0, std::string(slip).rfind(' '));
    const std::size_t at = slipped.find(key + " mm", slipped.find("flanges:"));
    REQUIRE(at != std::string::npos);
    slipped.replace(at, key.size() + 3, slip);
    try {
      static_cast<void>(parse_design(slipped, sound.file));
      FAIL_CHECK("read");
    } catch (const InputError& error) {
      INFO(error.what());
      CHECK(error.issues().size() == 1);
      CHECK_THAT(error.what(), !Catch::Matchers::Contains("is rolled"));
    }
  }
}
