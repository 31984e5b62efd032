// What is set on sections whose sides lean: laps, tabs and slots, rims, covers, liners. Every build proves that parts add up to what is
// listed, that none clash, and that edges are as long on the flat as finished.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_mesh.hpp"
#include "parts/bodies/clash.hpp"
#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace sections_test {

namespace {

using namespace glissade;
using namespace testing;

section::Trapezoid trapezoid(double lean_deg = 25.0) {
  return {WidthLaw(0.4), 0.25, Angle::from_degrees(lean_deg), 4e-3};
}

/// A block with a trough between its sides, the floor of which carries.
section::Polygon block() {
  section::Polygon polygon;
  polygon.outline = {{0.2, 0.0},    {0.3, 0.15},  {0.4, 0.15},  {0.36, -0.1},
                     {-0.36, -0.1}, {-0.4, 0.15}, {-0.3, 0.15}, {-0.2, 0.0}};
  return polygon;
}

double difference(const WorkshopBuild& build, const std::string& what) {
  for (const VolumeDifference& one : build.proof.differences) {
    if (one.what == what) return one.volume;
  }
  return 0.0;
}

void require_sound(const WorkshopBuild& build) {
  double sum = build.proof.exact_volume;
  for (const VolumeDifference& one : build.proof.differences) sum += one.volume;
  CHECK(std::fabs(build.proof.volume / sum - 1.0) < kPartsVolumeAccuracy);
  CHECK(build.proof.edge_mismatch < 1e-9);
  for (const ShopPart& part : build.workshop.parts) {
    INFO(part.name);
    REQUIRE(part.pattern);
    CHECK(faults_of(part.pattern->region).empty());
    CHECK(fault_of(part) == "");
    if (const auto* const sheet = std::get_if<RolledSheet>(&part.body)) {
      CHECK(sheet->region.holes.size() == part.pattern->region.holes.size());
      CHECK(sheet->region.cutouts.size() == part.pattern->region.cutouts.size());
    }
  }
}

std::string refused(const section::Measures& measures, const PlateOptions& options) {
  return refusal_of([&] { return plates_of(chute(), measures, options); });
}

}  // namespace

TEST_CASE(
    "sections: laps of a trapezoid reach beyond the corner by what is asked for, and differ by what is "
    "listed") {
  for (const WallSeat seat : {WallSeat::beside_floor, WallSeat::on_floor}) {
    PlateOptions options;
    options.walls = seat;
    const WorkshopBuild plain = plates_of(chute(), trapezoid(), options);
    options.corners.kind = CornerJoint::lap;
    const WorkshopBuild lap = plates_of(chute(), trapezoid(), options);
    require_sound(lap);
    CHECK(lap.proof.exact_volume == Approx(plain.proof.exact_volume).epsilon(1e-12));
    // Beyond the far face of 4 mm plate, square: 15 mm and what the corner of 65 deg lets the edge lean.
    const double sine = std::sin(65.0 * 3.14159265358979 / 180.0);
    const double cosine = std::cos(65.0 * 3.14159265358979 / 180.0);
    const double area = 2.0 * 4e-3 * (15e-3 + 0.5 * 4e-3 * cosine / sine);
    CHECK(difference(lap, "laps") == Approx(area * lap.master.spline->length()).epsilon(0.02));
    const ShopPart& passes = part_of(lap, seat == WallSeat::beside_floor ? "left_wall" : "floor");
    const auto& sheet = std::get<RolledSheet>(passes.body);
    const PlaneBox box = bounds(sheet.region.outline);
    const double long_side = seat == WallSeat::beside_floor
                                 ? 0.25 / std::cos(25.0 * 3.14159265358979 / 180.0) + 4e-3 / sine + 15e-3
                                 : 0.4 + 2.0 * (4e-3 / sine + 15e-3);
    CHECK(box.height() == Approx(long_side).epsilon(1e-9));
  }
}

TEST_CASE("sections: tabs of one plate stand in slots of the other, as many, larger by the clearance") {
  for (const WallSeat seat : {WallSeat::beside_floor, WallSeat::on_floor}) {
    PlateOptions options;
    options.walls = seat;
    options.corners.kind = CornerJoint::tab_and_slot;
    options.corners.overlap = 20e-3;
    const WorkshopBuild build = plates_of(chute(), trapezoid(), options);
    require_sound(build);
    std::size_t slots = 0;
    std::size_t steps = 0;
    for (const ShopPart& part : build.workshop.parts) {
      const auto* const sheet = std::get_if<RolledSheet>(&part.body);
      if (sheet == nullptr) continue;
      slots += part.quantity() * sheet->region.cutouts.size();
      const bool tabbed =
          part.name.find(seat == WallSeat::beside_floor ? "floor" : "wall") != std::string::npos;
      if (tabbed) steps += part.quantity() * (sheet->region.outline.vertices.size() - 4) / 4;
    }
    CHECK(slots > 20);
    CHECK(slots == steps);
    CHECK(-difference(build, "slots") / difference(build, "tabs") ==
          Approx(40.2 * 4.2 / 160.0).epsilon(2e-3));
    CHECK(build.proof.smallest_gap == Approx(0.1e-3));
    for (const ShopMeasurement& fact : build.workshop.measured) {
      if (fact.quantity == "web_thicknesses") CHECK(fact.in_units() >= 1.0);
    }
  }
}

TEST_CASE(
    "sections: v-channels and outlines lap where they turn by 30 deg or more, and are mitred elsewhere") {
  PlateOptions options;
  options.stave_tolerance = 20e-3;
  options.corners.kind = CornerJoint::lap;
  const WorkshopBuild v = plates_of(chute(), v_channel(), options);
  require_sound(v);
  CHECK(difference(v, "laps") > 0.0);
  PlateOptions thin = options;
  thin.polygon_thickness = 4e-3;
  const WorkshopBuild polygon = plates_of(chute(), block(), thin);
  require_sound(polygon);
  CHECK(refused(v_channel(),
                [] {
                  PlateOptions fine;
                  fine.corners.kind = CornerJoint::lap;
                  fine.stave_tolerance = 0.2e-3;
                  return fine;
                }())
            .find("corners|corners: no two plates of this section meet at a corner that could lap") == 0);
}

TEST_CASE("sections: where one of two plates begins after the start, what the other has more is listed") {
  PlateOptions options;
  options.corners.kind = CornerJoint::lap;
  options.walls = WallSeat::on_floor;
  options.stave_tolerance = 19e-3;
  options.split.longest = 1.2;
  options.flanges.wanted = false;
  const CoulombBrachistochrone steep({3.5, 2.6}, kFriction);
  const WorkshopBuild build = plates_of(steep, section::Pipe{0.411, 3e-3}, options);
  require_sound(build);
  CHECK(difference(build, "edges beyond the ends of other plates") != 0.0);
}

TEST_CASE("sections: rims lie along the tops outside, covers on them, bolted through the same holes") {
  for (const section::Measures& measures :
       {section::Measures(trapezoid()), section::Measures(v_channel()), section::Measures(block()),
        section::Measures(section::HalfPipe{0.4, 0.05, 4e-3})}) {
    PlateOptions options;
    options.rim.emplace();
    options.cover.emplace();
    options.split.longest = 2.9;
    const WorkshopBuild build = plates_of(chute(), measures, options);
    require_sound(build);
    std::size_t rim_holes = 0;
    std::size_t cover_holes = 0;
    std::size_t pieces = 0;
    for (const ShopPart* rim : named(build, "rim")) {
      rim_holes += rim->quantity() * rim->pattern->region.holes.size();
      pieces += rim->quantity();
    }
    for (const ShopPart* cover : named(build, "cover"))
      cover_holes += cover->quantity() * cover->pattern->region.holes.size();
    CHECK(pieces == 2 * (build.joints.size() - 1));
    CHECK(rim_holes > 20);
    CHECK(rim_holes == cover_holes);
  }
  PlateOptions rim;
  rim.rim.emplace();
  const WidthLaw widths(std::vector<WidthAt>{{0.0, 0.4}, {3.0, 0.4}, {6.0, 0.5}});
  const WorkshopBuild wider =
      plates_of(chute(), section::Trapezoid{widths, 0.25, Angle::from_degrees(20.0), 4e-3}, rim);
  CHECK(named(wider, "rim").size() >= 2);
}

TEST_CASE("sections: rims of mitred troughs are bars between the planes of their ends") {
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.rim.emplace();
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(12.0).radians(), {}, {}};
  const section::HalfPipe trough{0.3, 0.08, 3e-3};
  const WorkshopBuild build = plates_of(chute(), trough, options);
  std::size_t troughs = 0;
  std::size_t bars = 0;
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name.starts_with("trough_") && !part.name.starts_with("trough_flange"))
      troughs += part.quantity();
    if (!part.name.starts_with("rim")) continue;
    bars += part.quantity();
    CHECK(fault_of(part) == "");
  }
  CHECK(troughs > 3);
  CHECK(bars == 2 * troughs);
  CHECK(build.proof.added_volume > 40e-3 * 5e-3 * build.master.spline->length());
}

TEST_CASE(
    "sections: liners lie on the floor, of sections without a flat one on every plate, and ride as the track "
    "does") {
  for (const section::Measures& measures :
       {section::Measures(trapezoid()), section::Measures(v_channel()), section::Measures(block()),
        section::Measures(section::HalfPipe{0.5, 0.05, 4e-3})}) {
    // One of flat plates and one that is round, elsewhere than in CI.
    const bool chosen = std::holds_alternative<section::VChannel>(measures) ||
                        std::holds_alternative<section::HalfPipe>(measures);
    if (!chosen && !testing::thorough()) continue;
    PlateOptions options;
    options.liner.emplace();
    options.liner->bolt = 6;
    options.stave_tolerance = 8e-3;
    const WorkshopBuild plain = plates_of(chute(), measures, [&] {
      PlateOptions without = options;
      without.liner.reset();
      without.round = RoundMake::staves;
      return without;
    }());
    const WorkshopBuild build = plates_of(chute(), measures, options);
    require_sound(build);
    CHECK(build.ride.exit_speed == Approx(plain.ride.exit_speed).epsilon(1e-9));
    CHECK(difference(build, "holes of the liner") < 0.0);
    std::size_t tile_holes = 0;
    std::size_t below = 0;
    for (const ShopPart& part : build.workshop.parts) {
      const std::size_t holes = part.quantity() * part.pattern->region.holes.size();
      const bool frame = part.name.find("frame") != std::string::npos;
      if (part.name.find("tile") != std::string::npos)
        tile_holes += holes;
      else if (!frame)
        below += holes;
    }
    CHECK(tile_holes > 40);
    CHECK(tile_holes == below);
    std::size_t bolts = 0;
    for (const BoughtInItem& item : build.workshop.items) {
      if (item.name.starts_with("countersunk")) bolts += item.quantity;
    }
    CHECK(bolts == tile_holes);
    for (const ShopPart& part : build.workshop.parts) {
      // Stock is told by its thickness: not one of rounding.
      if (part.name.find("tile") != std::string::npos) CHECK(part.thickness == 6e-3);
    }
  }
}

TEST_CASE("sections: random sections, corners and fittings add up, do not clash and are closed") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t cutouts = 0;
  for (int run = 0; run < (testing::thorough() ? 8 : 3); ++run) {
    const ClothoidSpline track = testing::random_track(random, {.smallest = 2.0,
                                                                .largest = 6.0,
                                                                .crest = -0.6,
                                                                .valley = 0.9,
                                                                .shortest = 0.2,
                                                                .longest = 0.5,
                                                                .steepest = 55.0,
                                                                .fading = true});
    const double t = random.between(2e-3, 6e-3);
    const section::Trapezoid channel{WidthLaw(random.between(0.25, 0.6)), random.between(0.12, 0.3),
                                     Angle::from_degrees(random.between(0.0, 50.0)), t};
    PlateOptions options;
    options.walls = random.integer(0, 1) == 0 ? WallSeat::beside_floor : WallSeat::on_floor;
    options.corners.kind = run % 3 == 0 ? CornerJoint::lap : CornerJoint::tab_and_slot;
    options.corners.overlap = random.between(2.0, 4.0) * t + 2e-3;
    options.corners.tab = random.between(3.0, 8.0) * t;
    options.corners.clearance = random.between(0.0, 0.3e-3);
    options.flanges.wanted = random.integer(0, 2) > 0;
    options.flanges.bolt = 6;
    if (random.integer(0, 1) == 0) options.liner = LinerOptions{};
    if (random.integer(0, 1) == 0) options.rim = RimOptions{};
    if (options.rim && run % 2 == 0) options.cover = CoverOptions{};
    options.split.longest = random.between(1.0, 3.0);
    const WorkshopBuild build =
        plates_of(track, channel, options);  // throws where parts clash or do not add up
    require_sound(build);
    for (const ShopPart& part : build.workshop.parts) {
      cutouts += part.pattern->region.cutouts.size();
      if (run > 1) continue;
      const MeshFacts facts = measure(parts::facets_of(part.body, 2e-4));
      INFO(part.name);
      CHECK(facts.boundary_edges + facts.non_manifold_edges + facts.self_intersections == 0);
    }
  }
  CHECK(cutouts > 10);
}

TEST_CASE("sections: frames begin below what of a rim folds back") {
  section::Polygon folded;
  folded.outline = {{-0.2, -6e-3}, {0.2, -6e-3},  {0.32, 0.2},    {0.31, 0.206},
                    {0.196, 0.0},  {-0.196, 0.0}, {-0.31, 0.206}, {-0.32, 0.2}};
  for (const FlangeSection kind : {FlangeSection::flat, FlangeSection::angle}) {
    PlateOptions options;
    options.flanges.section = kind;
    if (kind == FlangeSection::angle) options.flanges.thickness = 5e-3;
    const WorkshopBuild build = plates_of(chute(), folded, options);
    require_sound(build);
    CHECK(parts::require_no_clash(build.workshop) > 0);
    const std::vector<const ShopPart*> frames =
        named(build, kind == FlangeSection::flat ? "end_frame" : "frame_angle");
    REQUIRE(!frames.empty());
    // From the outer edge of the rim on one side to that on the other, lying across the floor.
    if (kind == FlangeSection::angle) continue;
    const PlaneBox box = bounds(std::get<Prism>(frames.front()->body).region.outline);
    CHECK(box.high.y == Approx(0.2).margin(1e-9));
    CHECK(box.low.y == Approx(-6e-3 - 0.5e-3 - 50e-3).margin(1e-9));
  }
}

TEST_CASE("sections: what geometry forbids is refused with place, value, bound and a way out") {
  const auto liner = std::make_unique<PlateOptions>();  // of one on the stack GCC 12 warns
  liner->liner = LinerOptions{};
  liner->round = RoundMake::mitred;
  CHECK(
      refused(section::HalfPipe{0.3, 0.08, 3e-3}, *liner) ==
      "liner|liner: tiles are flat, mitred troughs are round inside|They would touch along two lines.|round: "
      "staves\n");
  PlateOptions rim;
  rim.rim.emplace();
  CHECK(refused(section::Pipe{0.3, 3e-3}, rim)
            .find("rim|rim: a closed section has no tops that it could lie along") == 0);
  PlateOptions narrow;
  narrow.liner.emplace();
  narrow.liner->thickness = 8e-3;
  narrow.liner->bolt = 10;
  narrow.stave_tolerance = 0.1e-3;
  const std::string stave = refused(v_channel(), narrow);
  CHECK(stave.find("liner.bolt|bolt: tiles on the stave_") == 0);
  CHECK(stave.find("of room|Holes for M10 take 30.4 mm with their edges and gaps.|a smaller bolt, a larger "
                   "stave_tolerance, or a larger radius") != std::string::npos);
  PlateOptions level;
  level.rim.emplace();
  level.cover.emplace();
  const section::Polygon block{{{0.2, 0.0}, {-0.2, 0.0}, {-0.25, -0.15}, {0.25, -0.15}}};
  CHECK(refused(block, level)
            .find("cover|cover: it would lie on the floor|The tops of this section are no "
                  "higher than that.|no cover, or a cross_section with sides above the "
                  "floor") == 0);
  PlateOptions wide;
  wide.corners.kind = CornerJoint::lap;
  const WidthLaw widths(std::vector<WidthAt>{{0.0, 0.4}, {3.0, 0.4}, {6.0, 0.5}});
  CHECK(refused(section::Trapezoid{widths, 0.25, Angle::from_degrees(20.0), 4e-3}, wide)
            .find("corners|corners: plates beside a width that changes meet edge against face") == 0);
  PlateOptions tiles;
  tiles.liner.emplace();
  tiles.floor = FloorMake::bent;
  CHECK(refused(section::Trapezoid{widths, 0.25, Angle::from_degrees(20.0), 4e-3}, tiles)
            .find("liner|liner: tiles on a bent floor have one width") == 0);
}

}  // namespace sections_test
