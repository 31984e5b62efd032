#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/pipeline.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <cmath>
#include <numbers>
#include <string>

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

/// Points of an arc of 12 m, from 40 deg down to level, that leads away from the x axis by an azimuth.
std::string arc_on_site(double azimuth, bool with_run) {
  std::string text = with_run ? "run_m,x_m,y_m,z_m\n" : "x_m,y_m,z_m\n";
  for (int i = 0; i <= 80; ++i) {
    const double slope = (40.0 - 0.5 * i) * std::numbers::pi / 180.0;
    const double run = 12.0 * (std::sin(40.0 * std::numbers::pi / 180.0) - std::sin(slope));
    if (with_run) text += exact_text(run) + ",";
    text += exact_text(100.0 + run * std::cos(azimuth)) + "," + exact_text(7.0 + run * std::sin(azimuth)) +
            "," + exact_text(50.0 - 12.0 * std::cos(slope)) + "\n";
  }
  return text;
}

/// @return the smallest radius that is read [m]
double radius_of(const std::string& csv, const std::string& columns) {
  const TempDir place;
  put_bytes(place / "site.csv", csv);
  put_bytes(place / "d.yaml",
            "glissade: 1\ntrack: {start: {x: 0 m, z: 9 m}}\nbody: {friction_coefficient: 0.05}\n"
            "centerline: {kind: points, file: site.csv, columns: " +
                columns + "}\n");
  return 1.0 / solve(read_design(place / "d.yaml")).centerline->at(3.0).curvature;
}

}  // namespace

TEST_CASE(
    "points of a track that leads away from the axis: a coordinate of the site is not taken for its run") {
  for (const double degrees : {4.0, 30.0, 45.0, 75.0, 150.0, 210.0}) {
    CAPTURE(degrees);
    const double azimuth = degrees * std::numbers::pi / 180.0;
    CHECK_THROWS_WITH(radius_of(arc_on_site(azimuth, true), "[x_m, z_m]"),
                      Contains("x_m is not the horizontal distance") && Contains("y_m changes by") &&
                          Contains("columns: [run_m, z_m]"));
    CHECK_THROWS_WITH(radius_of(arc_on_site(azimuth, false), "[x_m, z_m]"), Contains("sqrt(dx^2 + dy^2)"));
    CHECK(radius_of(arc_on_site(azimuth, true), "[run_m, z_m]") == Approx(12.0).epsilon(1e-3));
  }
  // Along an axis, or nearly so, its coordinate is the run.
  CHECK(radius_of(arc_on_site(0.0, true), "[x_m, z_m]") == Approx(12.0).epsilon(1e-3));
  CHECK(radius_of(arc_on_site(0.02, false), "[x_m, z_m]") == Approx(12.0).epsilon(2e-3));
  CHECK(radius_of(arc_on_site(std::numbers::pi / 2.0, false), "[y_m, z_m]") == Approx(12.0).epsilon(1e-3));
}

TEST_CASE("a point that lies far off the others is named, with its place and by how much") {
  const auto warned = [](double slip) {
    std::string text = "run_m,z_m\n";
    for (int i = 0; i < 100; ++i) {
      const double slope = (35.0 - 0.3 * i) * std::numbers::pi / 180.0;
      const double z = 50.0 - 60.0 * std::cos(slope) - (i == 33 ? slip : 0.0);
      text += exact_text(60.0 * (std::sin(35.0 * std::numbers::pi / 180.0) - std::sin(slope))) + "," +
              exact_text(z) + "\n";
    }
    const TempDir place;
    put_bytes(place / "site.csv", text);
    put_bytes(place / "d.yaml",
              "glissade: 1\ntrack: {start: {x: 0 m, z: 9 m}}\nbody: {friction_coefficient: 0.05}\n"
              "centerline: {kind: points, file: site.csv, columns: [run_m, z_m]}\n");
    const Design design = read_design(place / "d.yaml");
    std::string told;
    for (const Issue& issue : warnings(design, solve(design))) told += to_text(issue) + "\n";
    return told;
  };
  CHECK_THAT(warned(0.1), Contains("the curve misses point 34 of 100, at ") &&
                              Contains(" of the track, by ") && Contains(" times as much as the others") &&
                              Contains("that point looked at again, and left out if it is a slip"));
  CHECK_THAT(warned(0.0), !Contains("the curve misses point"));
}

TEST_CASE("points whose ends are too near or too far are refused before anything is fitted to them") {
  for (const char* const points : {"0,0\n1e-9,-1e-9\n2e-9,-1.5e-9\n3e-9,-1.6e-9\n",
                                   "0,0\n1000000,-300000\n2000000,-500000\n3000000,-600000\n"}) {
    INFO(points);
    CHECK_THROWS_WITH(radius_of("x,z\n" + std::string(points), "[x, z]"),
                      Contains("site.csv:5: the points end ") && Contains("from where they begin") &&
                          Contains("between 0.1 mm and 1000 km apart") && Contains("Try: the unit"));
  }
}
