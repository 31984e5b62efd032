#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/design/design.hpp"

#include "design/design_text.hpp"
#include "support/catch.hpp"

using namespace glissade;
using namespace glissade::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("an override replaces a value of the file, or adds one") {
  const Design design =
      parse_design(kSoundDesign, "d.yaml",
                   {{"body.friction_angle", "19deg"},
                    {"body.entry_speed", "2 m/s"},
                    {"cross_section", "{kind: pipe, inner_diameter: 100 mm, thickness: 2 mm}"},
                    {"export.0", "csv"},
                    {"export[1]", "stl-ascii"}});
  CHECK(design.body.friction == Friction::from_angle(Angle::from_degrees(19)));
  CHECK(design.body.entry_speed == 2.0);
  CHECK(design.cross_section == CrossSectionDesign(section::Pipe{0.1, 0.002}));
  CHECK(design.exports.formats ==
        std::vector{ExportFormat::csv, ExportFormat::stl_ascii, ExportFormat::scad});
  CHECK(design.where("body.friction_angle") == "--set body.friction_angle");
}

TEST_CASE("an override of one kind of friction takes the place of the other") {
  const Design design = parse_design(kSoundDesign, "d.yaml", {{"body.friction_coefficient", "0.25"}});
  CHECK(design.body.friction == Friction::from_coefficient(0.25));
}

TEST_CASE("a problem of an override names the override") {
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_angle", "19"}}),
             StartsWith("--set body.friction_angle: friction_angle: 19 has no unit"));
  CHECK_THAT(
      problems_of(kSoundDesign, {{"body.frction_angle", "19 deg"}}),
      StartsWith("--set body.frction_angle: unknown key frction_angle") && Contains("Try: friction_angle"));
  CHECK_THAT(problems_of(kSoundDesign, {{"name", ""}}), StartsWith("--set name: no value is given"));
  CHECK_THAT(problems_of(kSoundDesign, {{"export.7", "stl"}}),
             Contains("export has nothing that can be named \"7\""));
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_angle.x", "1"}}),
             Contains("body.friction_angle has nothing that can be named \"x\""));
  CHECK_THAT(problems_of(kSoundDesign, {{"track", "[a"}}),
             StartsWith("--set track: not valid YAML: this [ is not closed"));
  CHECK_THAT(problems_of(kSoundDesign, {{"body.friction_angle", "48 deg"}}),
             StartsWith("infeasible: --set body.friction_angle: friction_angle: 48 deg is steeper"));
}

TEST_CASE("a plain number with its unit is read as YAML would read it") {
  // A trailing blank or quotes take the long way round, through YAML.
  for (const char* text :
       {"19 deg", "19deg", "+1.9e1 deg", "0.33 rad", "1e-3rad", ".5 rad", "19 degrees", "19", "-19 deg",
        "1.5.2 deg", "0x13 deg", "19 deg/s", "19  deg", "7 -- 8", "19\t deg"}) {
    const auto told = [](const std::string& value) {
      try {
        return exact_text(parse_design(kSoundDesign, "d.yaml", {{"body.friction_angle", value}})
                              .body.friction.angle()
                              .radians());
      } catch (const Error& error) {
        return std::string(error.what());
      }
    };
    INFO(text);
    CHECK(told(text) == told(std::string(text) + " "));
    CHECK(told(text) == told("\"" + std::string(text) + "\""));
  }
}
