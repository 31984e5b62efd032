// Corners of channels: laps, tabs and slots. What is cut fits, and differs from the plain channel by what is listed.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace corners_test {

namespace {

using namespace glissade;
using namespace testing;

PlateOptions with_corners(CornerJoint kind, WallSeat seat = WallSeat::beside_floor,
                          FloorMake floor = FloorMake::rolled) {
  PlateOptions options;
  options.corners.kind = kind;
  options.walls = seat;
  options.floor = floor;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(4.0).radians(), {}, {}};
  return options;
}

double difference(const WorkshopBuild& build, const std::string& what) {
  for (const VolumeDifference& one : build.proof.differences) {
    if (one.what == what) return one.volume;
  }
  return 0.0;
}

}  // namespace

TEST_CASE("corners: laps and tabs differ from the plain channel by what is listed") {
  const WorkshopBuild plain = plates(chute(), with_corners(CornerJoint::butt));
  CHECK(plain.proof.differences.empty());
  for (const WallSeat seat : {WallSeat::beside_floor, WallSeat::on_floor}) {
    const WorkshopBuild lap = plates(chute(), with_corners(CornerJoint::lap, seat));
    const WorkshopBuild tab = plates(chute(), with_corners(CornerJoint::tab_and_slot, seat));
    CHECK(std::fabs(lap.proof.exact_volume / plain.proof.exact_volume - 1.0) < 1e-12);
    CHECK(std::fabs(tab.proof.exact_volume / plain.proof.exact_volume - 1.0) < 1e-12);
    // 15 mm of 4 mm plate on both sides, all along but for the frames.
    CHECK(std::fabs(difference(lap, "laps") / (2.0 * 15e-3 * 4e-3 * lap.master.spline->length()) - 1.0) <
          0.02);
    CHECK(difference(lap, "laps") == difference(tab, "laps"));
    CHECK(difference(tab, "tabs") > 0.0);
    // Slots are larger than tabs by 0.2 mm both ways: 40.2 x 4.2 against 40 x 4.
    CHECK(std::fabs(-difference(tab, "slots") / difference(tab, "tabs") - 40.2 * 4.2 / 160.0) < 1e-3);
    double sum = tab.proof.exact_volume;
    for (const VolumeDifference& one : tab.proof.differences) sum += one.volume;
    CHECK(std::fabs(tab.proof.volume / sum - 1.0) < kPartsVolumeAccuracy);
    CHECK(tab.proof.edge_mismatch < 1e-9);
  }
}

TEST_CASE("corners: as many slots as tabs, one every 300 mm, and they meet to the last digits on the flat") {
  const WorkshopBuild build = plates(chute(), with_corners(CornerJoint::tab_and_slot));
  for (const ShopPart& wall : build.workshop.parts) {
    if (!wall.name.starts_with("wall")) continue;
    const std::string unit = wall.name.substr(4);
    const auto& slots = wall.pattern->region.cutouts;
    REQUIRE(slots.size() > 5);
    for (const ShopPart& floor : build.workshop.parts) {
      if (floor.name != "floor" + unit) continue;
      const auto& corners = floor.pattern->region.outline.vertices;
      // Four corners a tab on each side, and four of the sheet.
      CHECK(corners.size() == 8 * slots.size() + 4);
      CHECK(std::fabs(bounds(floor.pattern->region.outline).height() - 0.408) < 1e-12);
      for (std::size_t i = 0; i + 1 < slots.size(); ++i) {
        const double flat = corners[4 * (i + 1) + 1].at.x - corners[4 * i + 1].at.x;
        CHECK(flat < 0.42);
        // Slots as the crow flies: no farther than along the floor.
        CHECK(norm(slots[i + 1].vertices[0].at - slots[i].vertices[0].at) < flat + 1e-4);
      }
    }
  }
}

TEST_CASE("corners: a sheet with slots weighs what a prism does where it has none") {
  const ArcPath path{{{{0.0, 0.0}, 0.1}, {{1.0, 0.0}, 0.0}, {{1.5, 0.25}, 0.0}}, false};
  const double t = 0.01;
  // The joint need not be smooth for moments; the piece after it lies square to itself.
  const double length_of_arc = length(pieces_of(path)[0]);
  const double whole = length(path);
  RolledSheet sheet{path, t, {rectangle({0.0, 0.0}, {whole, 0.3}), {}, {}}};
  const parts::BodyMoments plain = parts::moments(sheet);
  const double curvature = 4.0 * math::atan(0.1) / length_of_arc;
  const double exact = 0.3 * t * (whole + 0.5 * t * curvature * length_of_arc);
  CHECK(std::fabs(plain.volume / exact - 1.0) < 1e-14);
  CHECK(std::fabs(plain.centroid.z - 0.15) < 1e-15);
  sheet.region.cutouts.push_back(rectangle({0.2, 0.1}, {0.4, 0.2}));
  const parts::BodyMoments slotted = parts::moments(sheet);
  CHECK(std::fabs((plain.volume - slotted.volume) / (0.2 * 0.1 * t * (1.0 + 0.5 * t * curvature)) - 1.0) <
        1e-12);
  CHECK(parts::depth_inside(sheet, {0.75, -0.09, 0.05}) < 0.0);
  const Vec2 at = point_on(pieces_of(path)[0], 0.3 / length_of_arc);
  CHECK(parts::depth_inside(sheet, {at.x, at.y - 0.005, 0.15}) < 0.0);
  CHECK(parts::depth_inside(sheet, {at.x, at.y - 0.005, 0.05}) > 0.0);
}

TEST_CASE("corners: bodies with slots and tabs are closed surfaces of planes and cylinders") {
  for (const WallSeat seat : {WallSeat::beside_floor, WallSeat::on_floor}) {
    const WorkshopBuild build = plates(chute(), with_corners(CornerJoint::tab_and_slot, seat));
    std::size_t sheets = 0;
    for (const ShopPart& part : build.workshop.parts) {
      CHECK(fault_of(part) == "");
      sheets += std::holds_alternative<RolledSheet>(part.body) ? 1 : 0;
    }
    CHECK(sheets == build.joints.size() - 1);
  }
}

TEST_CASE("corners: random tracks, seats and floors fit, add up and are closed") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t tabs = 0;
  for (int run = 0; run < (testing::thorough() ? 12 : 4); ++run) {
    const ClothoidSpline track = testing::random_track(random, {.smallest = 2.0, .bends = 5, .fading = true});
    const double t = random.between(1.5e-3, 8e-3);
    const ChannelMeasures channel{random.between(0.2, 0.8), random.between(0.1, 0.3), t};
    const bool bent = random.integer(0, 2) == 0;
    PlateOptions options =
        with_corners(random.integer(0, 3) == 0 ? CornerJoint::lap : CornerJoint::tab_and_slot,
                     bent || random.integer(0, 1) == 0 ? WallSeat::beside_floor : WallSeat::on_floor,
                     bent ? FloorMake::bent : FloorMake::rolled);
    options.bend = {FacetRule::segment_length, random.between(0.2, 0.5), {}, {}};
    options.corners.overlap = random.between(1.2, 4.0) * t;
    options.corners.tab = random.between(2.5, 8.0) * t;
    options.corners.spacing = random.between(0.15, 0.4);
    options.corners.clearance = random.between(0.0, 0.3e-3);
    options.flanges.wanted = random.integer(0, 2) > 0;
    if (random.integer(0, 1) == 0)
      options.stiffeners = StiffenerOptions{0.5, options.corners.overlap + 40e-3, 6e-3};
    if (!bent && random.integer(0, 2) == 0) options.liner = LinerOptions{};
    if (random.integer(0, 1) == 0) options.rim = RimOptions{};
    if (options.rim && run % 2 == 0) options.cover = CoverOptions{};
    options.split.longest = random.between(0.8, 3.0);
    const WorkshopBuild build = plates(track, options, channel);  // throws where parts clash or do not add up
    for (const ShopPart& part : build.workshop.parts) {
      CHECK(faults_of(part.pattern->region).empty());
      CHECK(fault_of(part) == "");
      if (part.name.starts_with("wall")) tabs += part.pattern->region.cutouts.size();
    }
    for (const ShopMeasurement& fact : build.workshop.measured) {
      INFO(fact.where << " " << fact.quantity);
      // Flats of a bent floor leave the arcs of its walls by millimetres: what is left of an overlap is told.
      if (fact.quantity == "web_thicknesses" && !bent) CHECK(fact.in_units() >= 1.0 - 1e-9);
      if (fact.quantity == "tab_thicknesses") CHECK(fact.in_units() >= 2.0);
    }
  }
  CHECK(tabs > (testing::thorough() ? 20 : 6));
}

TEST_CASE("corners: what cannot be made is refused with place, value and bound") {
  PlateOptions narrow = with_corners(CornerJoint::tab_and_slot);
  narrow.corners.tab = 6e-3;
  CHECK(refusal(narrow).find(
            "corners.tab|tab: 6 mm is too narrow|Tabs are at least 2 thicknesses wide, and 3.2 mm: "
            "8 mm.|tab: 16 mm") != std::string::npos);
  PlateOptions web = with_corners(CornerJoint::tab_and_slot);
  web.corners.overlap = 3e-3;
  CHECK(refusal(web).find(
            "corners.overlap|overlap: 3 mm leaves too little beyond the slots|A web is at least as wide "
            "as its plate is thick, 4 mm.") != std::string::npos);
  PlateOptions loose = with_corners(CornerJoint::tab_and_slot);
  loose.corners.clearance = 3e-3;
  loose.corners.spacing = 50e-3;
  CHECK(refusal(loose).find("corners.clearance|clearance: 3 mm is out of range") != std::string::npos);
  CHECK(refusal(loose).find("corners.spacing|spacing: 50 mm is too close for tabs of 40 mm") !=
        std::string::npos);
  PlateOptions bent = with_corners(CornerJoint::tab_and_slot, WallSeat::beside_floor, FloorMake::bent);
  bent.bend = {FacetRule::segment_length, 45e-3, {}, {}};
  CHECK(refusal(bent).find(
            "corners.tab|tab: 40 mm finds no place on the floor of unit 1|Its longest flat between "
            "bends is ") != std::string::npos);
  CHECK(refusal(with_corners(CornerJoint::lap), {0.4, 0.0, 4e-3})
            .find("corners|corners: there are no walls that a floor could meet") != std::string::npos);
}

TEST_CASE("plates: patterns lie level in the least rectangle round them") {
  PlateOptions options;
  options.split.longest = 2.9;
  const WorkshopBuild build = plates(chute(), options);
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.name.starts_with("wall")) continue;
    const ArcPath& outline = part.pattern->region.outline;
    const PlaneBox box = bounds(outline);
    CHECK(std::fabs(box.low.x) + std::fabs(box.low.y) < 1e-12);
    for (int k = -60; k <= 60; ++k) {
      const PlaneBox turned =
          bounds(moved(outline, PlaneMotion::turn(Angle::from_degrees(0.75 * k).radians())));
      CHECK(box.width() * box.height() <= turned.width() * turned.height() * (1.0 + 1e-6));
    }
    CHECK(box.width() > box.height());
  }
}

}  // namespace corners_test
