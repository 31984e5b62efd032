#include "glissade/core/error.hpp"
#include "glissade/io/scad_file.hpp"
#include "glissade/io/stations_csv.hpp"

#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <limits>

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

std::string csv_of(const std::vector<StationRow>& stations) {
  const TempDir dir;
  write_stations_csv(dir / "stations.csv", {stations, {}});
  return bytes_of(dir / "stations.csv");
}

const std::string kHeading =
    "arc_length_m,run_m,drop_m,x_m,y_m,z_m,slope_angle_deg,curvature_per_m,radius_m,"
    "time_s,speed_m_per_s,normal_load_m_per_s2,friction_loss_j_per_kg,drag_loss_j_per_kg\n";

std::string scad_refusal(const std::vector<Vec3>& centerline) {
  const TempDir dir;
  try {
    write_scad(dir / "solid.scad", shapes::tetrahedron(), centerline);
  } catch (const InputError& error) {
    CHECK(dir.names().empty());
    return error.what();
  }
  return "no refusal";
}

}  // namespace

TEST_CASE("stations are one line of names with units and one line each, numbers in full") {
  StationRow row;
  row.point = {
      .arc_length = 1.0 / 3.0, .x = 0.25, .drop = 0.2, .slope_angle = 0.5235987755982989, .curvature = 0.5};
  row.position = {1.25, -0.0, 5.8};
  row.motion = MotionState{.arc_length = 1.0 / 3.0,
                           .time = 0.31,
                           .speed = 1e-7,
                           .normal_load = 9.81,
                           .friction_loss = 0.125,
                           .drag_loss = 0.0};
  CHECK(csv_of({row}) == kHeading +
                             "0.3333333333333333,0.25,0.2,1.25,0,5.8,30.000000000000004,0.5,2,"
                             "0.31,1e-07,9.81,0.125,0\n");
}

TEST_CASE("stations where the body does not come have empty columns, unbounded numbers are inf") {
  StationRow straight;
  StationRow nose;
  nose.point.curvature = std::numeric_limits<double>::infinity();
  CHECK(csv_of({straight, nose}) == kHeading + "0,0,0,0,0,0,0,0,inf,,,,,\n" + "0,0,0,0,0,0,0,inf,0,,,,,\n");
}

TEST_CASE("a station that is not a number is refused and nothing is written") {
  StationRow row;
  row.point.drop = std::numeric_limits<double>::quiet_NaN();
  const TempDir dir;
  CHECK_THROWS_WITH(write_stations_csv(dir / "stations.csv", {{StationRow{}, row}, {}}),
                    Contains("station 1: drop_m is not a number"));
  CHECK(dir.names().empty());
}

TEST_CASE("of a friction range the columns of motion follow for each end, the unit last") {
  StationRow row;
  row.motion = MotionState{};
  MotionState slow;
  slow.speed = 2.5;
  const TempDir dir;
  write_stations_csv(dir / "stations.csv",
                     {{row}, {{FrictionLevel::low, {{}}}, {FrictionLevel::high, {slow}}}});
  const std::string text = bytes_of(dir / "stations.csv");
  CHECK_THAT(text, Contains(",drag_loss_j_per_kg,time_low_s,speed_low_m_per_s,normal_load_low_m_per_s2,"
                            "friction_loss_low_j_per_kg,drag_loss_low_j_per_kg,time_high_s,"));
  CHECK_THAT(text, Contains(",0,0,0,0,0,,,,,,0,2.5,0,0,0\n"));
}

TEST_CASE("what a law says follows the motion that it is of, the unit last") {
  StationRow row;
  row.motion = MotionState{};
  const double infinity = std::numeric_limits<double>::infinity();
  const StationTable table{{row, StationRow{}},
                           {{FrictionLevel::high, {{}, {}}, {{"burden_depth_m", {0.25, {}}}}}},
                           {{"burden_depth_m", {0.5, {}}}, {"friction_needed", {infinity, {}}}}};
  const TempDir dir;
  write_stations_csv(dir / "stations.csv", table);
  const std::string text = bytes_of(dir / "stations.csv");
  CHECK_THAT(text, Contains(",drag_loss_j_per_kg,burden_depth_m,friction_needed,time_high_s,") &&
                       Contains(",drag_loss_high_j_per_kg,burden_depth_high_m\n"));
  CHECK_THAT(text, Contains(",0,0,0,0,0,0.5,inf,,,,,,0.25\n") && Contains(",inf,,,,,,,,,,,,,\n"));
}

TEST_CASE("an OpenSCAD file says unit, name and section, and holds doubles in full") {
  const TempDir dir;
  write_scad(dir / "solid.scad", shapes::tetrahedron(), {{0, 0, 1.0 / 3.0}, {0, 2, 0}},
             {.unit = LengthUnit::metre, .name = "Nose */\ncube(1);", .section = "pipe"});
  const std::string text = bytes_of(dir / "solid.scad");
  CHECK(text.find("// Glissade; unit: m; Nose */ cube(1);\n// Cross-section: pipe\n") == 0);
  CHECK_THAT(text, Contains("points = [\n[0,0,0],\n[1,0,0],\n[0,1,0],\n[0,0,1]\n], faces = [\n[0,1,2],"));
  CHECK_THAT(text, Contains("glissade_centerline_points() = [\n[0,0,0.3333333333333333],\n[0,2,0]\n];"));
  CHECK_THAT(text, Contains("glissade_direction() = [0,1,0];"));
}

TEST_CASE("an OpenSCAD file needs a centerline in one vertical plane") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK_THAT(scad_refusal({{0, 0, 0}}), Contains("centerline: has 1 point"));
  CHECK_THAT(scad_refusal({{0, 0, 0}, {1, 0, infinity}}),
             Contains("centerline, point 1: a coordinate is not"));
  CHECK_THAT(scad_refusal({{0, 0, 0}, {1, 0.001, 0}, {2, 0, 0}}),
             Contains("centerline, point 1: lies 1 mm beside the plane of the track"));
  CHECK(scad_refusal({{0, 0, 1}, {0, 0, 0}}) == "no refusal");
}
