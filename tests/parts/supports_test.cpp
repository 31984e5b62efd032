// How far apart trestles stand.

#include "glissade/parts/plates.hpp"
#include "glissade/pipeline.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace glissade;
using namespace testing;

namespace {

/// The longest stretch of track between two trestles [m].
double widest_span(const WorkshopBuild& build) {
  std::vector<double> places;
  for (const SettingOutPoint& point : build.workshop.setting_out) {
    if (point.what.rfind("support ", 0) == 0) places.push_back(point.arc_length);
  }
  REQUIRE(std::is_sorted(places.begin(), places.end()));
  double widest = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) widest = std::max(widest, places[i] - places[i - 1]);
  return widest;
}

bool tells_of_spans(const WorkshopBuild& build) {
  return std::any_of(build.workshop.notes.begin(), build.workshop.notes.end(),
                     [](const std::string& note) { return note.rfind("Trestles are up to ", 0) == 0; });
}

}  // namespace

TEST_CASE("trestles are no farther apart than is asked for, or a note says where and why") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  PlateOptions options;
  options.split.longest = 2.9;
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  bool kept = false;
  bool told = false;
  for (int i = 0; i < (testing::thorough() ? 12 : 3); ++i) {
    options.stiffeners.reset();
    if (i % 2 == 1) options.stiffeners.emplace();
    options.supports->spacing = i == 0 ? 0.25 : i == 1 ? 1.8 : random.between(0.25, 3.0);
    INFO("spacing " << options.supports->spacing << (options.stiffeners ? ", stiffeners" : ""));
    const WorkshopBuild build = plates(chute(), options);
    const bool wide = widest_span(build) > options.supports->spacing + 1e-3;
    CHECK(wide == tells_of_spans(build));
    kept = kept || !wide;
    told = told || wide;
  }
  CHECK(kept);
  CHECK(told);
}

TEST_CASE("trestles: one more stands where the places that are free would leave a span too wide") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.stiffeners.emplace();
  options.supports.emplace();
  options.supports->ground = {{0.0, -6.2}};
  for (const double spacing : {1.6, 1.8, 1.9, 2.2}) {
    INFO("spacing " << spacing);
    options.supports->spacing = spacing;
    CHECK(widest_span(plates(chute(), options)) <= spacing + 1e-9);
  }
}

TEST_CASE("trestles: beams of any width stand clear of a steep track, its frames and what is welded to it") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.liner.emplace();
  options.rim.emplace();
  options.stiffeners.emplace();
  options.supports.emplace();
  SupportOptions& supports = *options.supports;
  supports.ground = {{0.0, -8.2}};
  supports.steepest = Angle::from_degrees(66.0);
  const auto set = [&](double spacing, double tube) {
    supports.spacing = spacing;
    supports.tube = tube;
    INFO("spacing " << spacing << ", tube " << tube);
    // Throws InternalError where one reaches into another.
    CHECK(!named(plates(chute(), options), "beam").empty());
  };
  for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
    options.floor = floor;
    if (floor == FloorMake::rolled || testing::thorough()) set(1.687, 100e-3);
    // The widest and the narrowest below a rolled floor, the other below a bent one, elsewhere than in CI.
    for (const double tube : {80e-3, 110e-3, 150e-3}) {
      if (testing::thorough() || (tube == 110e-3) == (floor == FloorMake::bent)) set(1.9, tube);
    }
  }
}

TEST_CASE("trestles carry a track with grooves, thin or thick below them, on the underside of its outline") {
  PlateOptions options;
  options.supports.emplace();
  options.supports->ground = {{0.0, -8.2}};
  options.supports->spacing = 1.5;
  options.supports->steepest = Angle::from_degrees(75.0);
  for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
    options.floor = floor;
    for (const double thickness : {0.03, 0.04, 0.12}) {
      INFO("thickness " << thickness);
      if (!testing::thorough() && (thickness == 0.04) != (floor == FloorMake::bent)) continue;
      section::TrackGroove track;
      track.width = WidthLaw(0.4);
      track.groove_width = 0.08;
      track.groove_depth = 0.04;
      track.groove_spacing = 0.2;
      track.thickness = thickness;
      // Throws InternalError where one reaches into another.
      const WorkshopBuild build = plates_of(chute(), track, options);
      CHECK(named(build, "saddle").size() >= 2);
      CHECK_FALSE(named(build, "frame").empty());
    }
  }
}

TEST_CASE("trestles: saddles stand beside stiffeners that lean over them") {
  const Design design = parse_design(
      "glissade: 1\n"
      "track: {start: {x: -4 m, z: 0 m}}\n"
      "body: {friction_angle: 8 deg, entry_speed: 0.5 m/s}\n"
      "centerline:\n"
      "  kind: segments\n"
      "  entry_slope_angle: 35 deg\n"
      "  segments:\n"
      "    - {length: 0.5 m}\n"
      "    - {to_slope_angle: 50 deg, radius: -7.5 m}\n"
      "    - {to_slope_angle: 25 deg, radius: 3 m}\n"
      "    - {to_slope_angle: 35 deg, radius: -10 m}\n"
      "    - {length: 0.5 m}\n"
      "    - {to_slope_angle: 15 deg, radius: 4.5 m}\n"
      "cross_section: {kind: pipe, inner_diameter: 420 mm, thickness: 8 mm}\n"
      "fabrication:\n"
      "  process: plate\n"
      "  floor: bent\n"
      "  round: staves\n"
      "  stiffeners: {spacing: 600 mm}\n"
      "  supports: {ground: -9.5 m, spacing: 0.9 m, steepest: 75 deg}\n"
      "mesh: {tolerance: 3 mm}\n"
      "export: [tables]\n",
      "pipe.yaml");
  // Throws InternalError where one reaches into another.
  const Assembly assembly = assemble(design, solve(design));
  REQUIRE(assembly.fabrication);
  CHECK_FALSE(named(*assembly.fabrication, "saddle").empty());
}

TEST_CASE("trestles: base plates of both legs lie beside each other, however thin tubes and section are") {
  const CoulombBrachistochrone track({0.95, 1.25}, Friction::from_angle(Angle::from_degrees(24.0)));
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(7.5).radians(), {}, {}};
  options.supports.emplace();
  options.supports->ground = {{0.0, -5.0}};
  for (const double tube : {40e-3, 50e-3, 60e-3}) {
    INFO("tube " << tube);
    options.supports->tube = tube;
    const WorkshopBuild build = plates_of(track, section::Pipe{0.15, 2e-3}, options);
    for (const ShopPart* const plate : named(build, "base_plate")) {
      REQUIRE(plate->places.size() % 2 == 0);
      const double apart = plate->places[0].origin.y - plate->places[1].origin.y;
      CHECK(std::fabs(apart) >= bounds(plate->pattern->region.outline).width() + 10e-3 - 1e-9);
    }
  }
}
