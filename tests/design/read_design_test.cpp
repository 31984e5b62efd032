#include "glissade/design/design.hpp"

#include "support/catch.hpp"
#include "support/paths.hpp"

using namespace glissade;

TEST_CASE("the grain chute reads as its file says, in SI units") {
  const Design design = read_design(designs_path("grain_chute.yaml"));
  CHECK(design.name == "Grain chute, silo 3 to belt B");
  CHECK(design.track.start == Vec3{0.0, 0.0, 6.2});
  CHECK(design.track.finish == Vec3{5.4, 0.0, 1.1});
  CHECK(design.body.friction == Friction::from_angle(Angle::from_degrees(17.0)));
  CHECK(design.body.entry_speed == 0.0);
  CHECK(design.gravity == 9.81);
  CHECK(design.centerline.kind == CenterlineKind::fastest);
  CHECK(design.cross_section == CrossSectionDesign(section::UChannel{0.4, 0.25, 0.004}));
  CHECK(design.mesh.tolerance == 0.0005);
  CHECK(design.exports.formats == std::vector{ExportFormat::stl, ExportFormat::off, ExportFormat::scad});
  CHECK(design.exports.unit == LengthUnit::millimetre);
  CHECK(design.where("body.friction_angle") == designs_path("grain_chute.yaml:7:19"));
  CHECK(check(design).empty());
}
