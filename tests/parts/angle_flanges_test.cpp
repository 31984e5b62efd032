// Flanges of angles: frames of mitred pieces, rings rolled from one bar.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/slot.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/bolt_faults.hpp"
#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/plates/angle_frames.hpp"
#include "parts/random_tracks.hpp"
#include "parts/refusals.hpp"
#include "parts/shop/bolts.hpp"
#include "parts/shop/equal_parts.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"
#include "support/thorough.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace angle_flanges_test {

namespace {

using namespace glissade;
using namespace testing;

PlateOptions with_angles() {
  PlateOptions options;
  options.flanges.as_told = true;
  options.flanges.section = FlangeSection::angle;
  options.split.longest = 2.5;
  return options;
}

std::vector<const ShopPart*> angles_of(const WorkshopBuild& build) {
  std::vector<const ShopPart*> found;
  for (const ShopPart& part : build.workshop.parts) {
    if (std::holds_alternative<AngleBar>(part.body)) found.push_back(&part);
  }
  return found;
}

std::size_t bought(const WorkshopBuild& build, const std::string& name) {
  std::size_t count = 0;
  for (const BoughtInItem& item : build.workshop.items)
    count += item.name.find(name) == 0 ? item.quantity : 0;
  return count;
}

std::vector<section::Measures> sections(double width, double t) {
  return {section::Measures(section::UChannel{WidthLaw(width), 0.25, t}),
          section::Measures(section::Trapezoid{WidthLaw(width), 0.25, Angle::from_degrees(35.0), t}),
          section::Measures(section::Slab{WidthLaw(width), t, 0.0, 0.0}),
          section::Measures(section::HalfPipe{width, 0.1, t}),
          section::Measures(section::HalfPipe{width, 0.0, t}),
          section::Measures(section::Pipe{width, t})};
}

/// Middles of holes and slots of an angle.
std::vector<Vec2> middles_of(const AngleBar& bar) {
  std::vector<Vec2> middles;
  for (const Circle& hole : bar.holes) middles.push_back(hole.centre);
  for (const ArcPath& slot : bar.slots) middles.push_back(as_slot(slot)->middle);
  return middles;
}

double nearest(const ArcPath& path, Vec2 at) {
  const PathPiece here{at, at + Vec2{1e-9, 0.0}, 0.0};
  double least = 1e9;
  for (const PathPiece& piece : pieces_of(path)) least = std::min(least, distance(here, piece));
  return least;
}

/// A bar is a solid with room for washers beside its fillet and for holes beside its toe and its cuts.
void check_bar(const ShopPart& part, const FlangeOptions& flange) {
  INFO(part.name);
  const auto& bar = std::get<AngleBar>(part.body);
  CHECK(faults_of(part.pattern->region).empty());
  if (!parts::is_rolled(bar)) CHECK(fault_of(part).empty());  // by chords, which of half circles hold nothing
  const MeshFacts mesh = measure(parts::facets_of(part.body, 1e-5));
  CHECK(mesh.boundary_edges + mesh.non_manifold_edges + mesh.self_intersections == 0);
  CHECK(std::fabs(mesh.volume / part.volume - 1.0) < 1e-3);
  CHECK(std::fabs(part.mass - 7850.0 * part.volume) < 1e-9);
  const double hole = clearance_hole(flange.bolt, HoleFit::coarse);
  const double root = *parts::root_radius(flange.width, flange.thickness);
  const std::vector<Vec2> middles = middles_of(bar);
  CHECK(!middles.empty());
  for (const Vec2 middle : middles) {
    CHECK(nearest(bar.root, middle) > root + 0.5 * parts::bolt_of(flange.bolt).washer - 1e-9);
    CHECK(nearest(bar.toe, middle) > 1.2 * hole - 1e-9);
    CHECK(nearest(part.pattern->region.outline, middle) > 1.2 * hole - 1e-9);
  }
}

/// Legs that lie in the joint's plane, without their holes.
double lying_area(const WorkshopBuild& build) {
  double area = 0.0;
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name.find("frame") == std::string::npos && part.name.find("flange") == std::string::npos)
      continue;
    PlaneRegion region = part.pattern->region;
    region.holes.clear();
    std::erase_if(region.cutouts, [](const ArcPath& cutout) { return as_slot(cutout).has_value(); });
    area += moments(region).area * static_cast<double>(part.quantity());
  }
  return area;
}

}  // namespace

TEST_CASE("angle flanges: sections of bars with their fillets have the areas that the standard tells") {
  struct Row {
    double leg;
    double thickness;
    double area;  // EN 10056-1 [cm^2]
  };
  const std::array<Row, 25> rows = {
      {{20, 3, 1.12},   {25, 4, 1.85},   {30, 3, 1.74},   {35, 4, 2.67},   {40, 4, 3.08},
       {45, 4.5, 3.90}, {50, 5, 4.80},   {50, 6, 5.69},   {60, 6, 6.91},   {65, 7, 8.70},
       {70, 7, 9.40},   {75, 8, 11.4},   {80, 8, 12.3},   {90, 9, 15.5},   {100, 10, 19.2},
       {120, 12, 27.5}, {75, 6, 8.73},   {110, 10, 21.2}, {110, 12, 25.1}, {120, 15, 33.9},
       {130, 12, 30.0}, {150, 10, 29.3}, {150, 12, 34.8}, {150, 15, 43.0}, {150, 18, 51.0}}};
  for (const Row& row : rows) {
    INFO(row.leg << " x " << row.thickness);
    const auto root = parts::root_radius(1e-3 * row.leg, 1e-3 * row.thickness);
    REQUIRE(root);
    const double sharp = (2.0 * row.leg - row.thickness) * row.thickness;
    // A fillet at the root, and half its radius off both toes.
    const double r = 1e3 * *root;
    const double rolled = sharp + (1.0 - 0.25 * std::numbers::pi) * (r * r - 2.0 * 0.25 * r * r);
    CHECK(std::fabs(0.01 * rolled / row.area - 1.0) < 5e-3);
    CHECK(sharp < 100.0 * row.area * 1.003);
    CHECK(sharp > 0.98 * 100.0 * row.area);
  }
  CHECK(!parts::root_radius(50e-3, 5.5e-3));
}

TEST_CASE("angle flanges: a bar's volume, middle and depth are those of points strewn through it") {
  for (const AngleBar& bar : {mitred_angle(), angle_ring(), half_angle_ring()}) {
    // Of closed and open ones, the heel lies within the box or on its edge.
    PlaneBox box = bounds(bar.toe);
    box.low.y = std::min(box.low.y, bounds(bar.heel).low.y);
    Random random = seeded_random();
    INFO("GLISSADE_SEED=" << random.seed());
    double inside = 0.0;
    Vec3 sum;
    Vec3 squares;
    const int points = testing::thorough() ? 60000 : 15000;
    for (int k = 0; k < points; ++k) {
      const Vec3 point{random.between(box.low.x, box.high.x), random.between(box.low.y, box.high.y),
                       random.between(0.0, bar.height)};
      if (!(parts::depth_inside(bar, point) > 0.0)) continue;
      inside += 1.0;
      sum = sum + point;
      squares = squares + Vec3{point.x * point.x, point.y * point.y, point.z * point.z};
    }
    const parts::BodyMoments all = parts::moments(bar);
    const double volume = inside / points * box.width() * box.height() * bar.height;
    // Five standard errors, here of a share that is counted, below of means.
    CHECK(std::fabs(volume / all.volume - 1.0) < 5.0 * std::sqrt((1.0 - inside / points) / inside));
    const auto is_middle = [&](double added, double squared, double middle) {
      const double mean = added / inside;
      CAPTURE(mean, middle);
      CHECK(std::fabs(mean - middle) < 5.0 * std::sqrt((squared / inside - mean * mean) / inside));
    };
    is_middle(sum.x, squares.x, all.centroid.x);
    is_middle(sum.y, squares.y, all.centroid.y);
    is_middle(sum.z, squares.z, all.centroid.z);
    const MeshFacts mesh = measure(parts::facets_of(bar, 1e-7));
    CHECK(std::fabs(mesh.volume / all.volume - 1.0) < 1e-5);
    ShopPart part = shop_part(1, "angle", bar);
    parts::weigh(part);
    if (!parts::is_rolled(bar)) CHECK(fault_of(part).empty());
    CHECK(faults_of(parts::lying_leg(bar)).empty());
  }
}

TEST_CASE("angle flanges: turned round they are one part, mirrored they are not") {
  ShopPart part = shop_part(1, "angle", mitred_angle());
  part.pattern = FlatPattern{parts::lying_leg(mitred_angle()), {}, {}, {}, {}, 0.0};
  part.bought_in = true;
  const PlaneMotion turn = PlaneMotion::turn(2.0, {0.3, -0.1});
  const auto with = [&](const PlaneMotion& motion, bool backward) {
    ShopPart other = part;
    AngleBar bar = mitred_angle();
    for (ArcPath* const line : {&bar.heel, &bar.root, &bar.toe})
      *line = backward ? reversed(moved(*line, motion)) : moved(*line, motion);
    for (Circle& hole : bar.holes) hole.centre = motion(hole.centre);
    for (ArcPath& slot : bar.slots) slot = moved(slot, motion);
    other.body = bar;
    other.pattern->region = parts::lying_leg(bar);
    return other;
  };
  const auto place = parts::place_in(part, with(turn, false));
  REQUIRE(place);
  CHECK(norm(place->to_space({0.1, 0.037, 0.0}) - Vec3{turn({0.1, 0.037}).x, turn({0.1, 0.037}).y, 0.0}) <
        1e-9);
  PlaneMotion mirror;
  mirror.mirrored = true;
  CHECK(!parts::place_in(part, with(mirror, true)));
  CHECK(!parts::mirror_images(part, with(mirror, true)));
}

TEST_CASE("angle flanges: every section gets pieces or rings whose bolts meet, no part in another") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const std::vector<section::Measures> all = sections(random.between(0.35, 0.6), random.between(2e-3, 5e-3));
  for (std::size_t k = 0; k < 2 * all.size(); ++k) {
    const section::Measures& measures = all[k / 2];
    PlateOptions options = with_angles();
    FlangeOptions& flange = options.flanges;
    flange.gap = 3e-3;
    const bool slots = k % 2 == 1;
    if (slots) {
      flange.slotted = random.integer(0, 1) == 0 ? FlangeSide::upstream : FlangeSide::downstream;
      flange.width = 70e-3;
      flange.thickness = 7e-3;
    } else {
      const int size = random.integer(0, 2);
      flange.width = std::array{40e-3, 50e-3, 60e-3}[static_cast<std::size_t>(size)];
      flange.thickness = std::array{4e-3, 5e-3, 6e-3}[static_cast<std::size_t>(size)];
      flange.bolt = std::array{8, 10, 12}[static_cast<std::size_t>(size)];
    }
    flange.pitch = random.between(0.08, 0.2);
    const ClothoidSpline track =
        random_track(random, {.smallest = 5.0, .largest = 8.0, .bends = 2, .crest = -0.3, .valley = 0.6});
    INFO("kind " << measures.index() << ", leg " << flange.width << ", slots " << slots);
    // Throws where holes do not meet or parts clash.
    const WorkshopBuild build = plates_of(track, measures, options);
    CHECK(build.proof.bolted == bought(build, "bolt M" + std::to_string(flange.bolt)));
    const std::vector<const ShopPart*> angles = angles_of(build);
    REQUIRE(!angles.empty());
    for (const ShopPart* const part : angles) check_bar(*part, flange);
    // Mitred pieces cover what a frame cut from one plate does.
    PlateOptions flat = options;
    flat.flanges.section = FlangeSection::flat;
    flat.flanges.slotted.reset();
    flat.flanges.bolt = 5;
    const WorkshopBuild cut = plates_of(track, measures, flat);
    if (std::holds_alternative<section::Slab>(measures))
      continue;  // bars of one plate stand out to the sides
    if (cut.joints.size() == build.joints.size())
      CHECK(std::fabs(lying_area(build) / lying_area(cut) - 1.0) < 1e-9);
  }
}

TEST_CASE("angle flanges: the legs along a bent floor and a mitred pipe stand on one flat each") {
  PlateOptions options = with_angles();
  options.floor = FloorMake::bent;
  const WorkshopBuild bent = plates(chute(), options);
  std::size_t looked_at = 0;
  for (const ShopPart* const part : named(bent, "floor")) {
    if (!part->pattern || part->pattern->bends.empty()) continue;
    const double whole = bounds(part->pattern->region.outline).width();
    CHECK(part->pattern->bends.front().from.x > 50e-3);
    CHECK(part->pattern->bends.back().from.x < whole - 50e-3);
    ++looked_at;
  }
  CHECK(looked_at >= bent.joints.size() - 1);
  CHECK(bent.proof.smallest_gap > 0.4e-3);
  const WorkshopBuild pipe = plates_of(chute(), section::Pipe{0.3, 3e-3}, with_angles());
  const ShopPart& ring = part_of(pipe, "pipe_flange");
  const auto& bar = std::get<AngleBar>(ring.body);
  CHECK(bar.heel.closed);
  // Pappus: the section without holes goes round with its centroid.
  double holes = 0.0;
  for (const Circle& hole : bar.holes) holes += std::numbers::pi * hole.radius * hole.radius * bar.thickness;
  const double section = (2.0 * 50.0 - 6.0) * 6.0 * 1e-6;
  CHECK(std::fabs((ring.volume + holes) / (section * parts::stock_length(bar)) - 1.0) < 1e-12);
  const auto row = std::find_if(pipe.workshop.bends.begin(), pipe.workshop.bends.end(),
                                [&](const BendStep& step) { return step.part == ring.number; });
  REQUIRE(row != pipe.workshop.bends.end());
  CHECK(std::fabs(row->length - parts::stock_length(bar)) < 1e-12);
  CHECK(std::fabs(row->radius - 153.5e-3) < 1e-12);
  double stretched = 0.0;
  for (const ShopMeasurement& one : pipe.workshop.measured) {
    if (one.quantity == "angle_elongation") stretched = one.in_units();
  }
  // 50 x 50 x 6 mm: the centroid lies 14.5 mm from the heel (EN 10056-1), with sharp corners 1 % farther.
  CHECK(std::fabs(stretched / ((50.0 - 14.5) / (153.5 + 14.5)) - 1.0) < 0.01);
}

TEST_CASE("angle flanges: a slot stands upright in every piece, and a unit moved aside is found out") {
  PlateOptions options = with_angles();
  options.flanges.width = 70e-3;
  options.flanges.thickness = 7e-3;
  options.flanges.slotted = FlangeSide::downstream;
  const section::Trapezoid leaning{WidthLaw(0.5), 0.25, Angle::from_degrees(30.0), 4e-3};
  const WorkshopBuild build = plates_of(chute(), leaning, options);
  for (const ShopPart* const part : angles_of(build)) {
    const auto& bar = std::get<AngleBar>(part->body);
    CHECK(bar.slots.empty() == (part->name.find("_slotted") == std::string::npos));
    for (const ArcPath& slot : bar.slots) {
      const Vec2 reach = as_slot(slot)->reach;
      const Frame& place = part->places.front();
      const Vec3 there = reach.x * place.x + reach.y * place.y;
      CHECK(std::fabs(there.y) < 1e-12);  // across the track: the plane of which is x-z
    }
  }
  Workshop workshop = build.workshop;
  for (ShopPart& part : workshop.parts) {
    if (part.name.find("_slotted") == std::string::npos) continue;
    for (Frame& place : part.places) place.origin.y += 0.1e-3;
  }
  CHECK(bolt_fault(build.workshop).empty());
  CHECK(bolt_fault(workshop).find("off the axis of that in") != std::string::npos);
}

TEST_CASE("angle flanges: what no shop rolls or bolts is told with a bar that does") {
  PlateOptions options = with_angles();
  options.flanges.thickness = 5.5e-3;
  CHECK(refusal(options) ==
        "flanges.thickness|section: no angle of 50 x 50 x 5.5 mm is rolled|Equal angles are those of EN "
        "10056-1.|thickness: 4, 5 or 6 mm, or section: flat\n");
  options.flanges.width = 52e-3;
  CHECK(
      refusal(options).find("flanges.width|section: no angle of 52 x 52 x 5.5 mm is rolled|Equal angles are "
                            "those of EN 10056-1.|width: 50 mm with thickness: 4, 5 or 6 mm, or") == 0);
  options = with_angles();
  options.flanges.bolt = 16;
  const std::string told = refusal(options);
  CHECK(told.find("flanges.bolt|bolt: M16 finds no place in an angle of 50 x 50 x 6 mm|") == 0);
  CHECK(told.find("|width: 60 mm with thickness: 5 mm, or a smaller bolt\n") != std::string::npos);
  options.flanges.width = 60e-3;
  options.flanges.thickness = 5e-3;
  CHECK(refusal(options).empty());
  options = with_angles();
  options.flanges.slotted = FlangeSide::upstream;
  CHECK(
      refusal(options).find(
          "flanges.bolt|bolt: M10 in slots of 25 mm finds no place in an angle of 50 x 50 x 6 mm|Washers of "
          "30 "
          "mm begin 4 mm from the other leg, its fillet is 7 mm (EN 10056-1).|width: 65 mm with thickness: 7 "
          "mm, or a smaller bolt or a shorter slot\n") == 0);
  // Staves so narrow that no bolt keeps off both cuts.
  options = with_angles();
  options.round = RoundMake::staves;
  options.stave_tolerance = 0.1e-3;
  const std::string narrow = refusal_of([&] {
    return plates_of(chute(), section::Pipe{0.3, 3e-3}, options);
  });
  CHECK(narrow.find("flanges.section|section: angle finds no place for M10 along a side of 11") == 0);
  CHECK(
      narrow.find(" mm|Each side has a piece of its own, whose holes of 12 mm keep 18 mm off the cuts at its "
                  "ends.|section: flat, or a smaller bolt\n") != std::string::npos);
  // A bend within the leg that no choice of flats leaves out.
  options = with_angles();
  options.floor = FloorMake::bent;
  options.split.longest.reset();
  const ClothoidSpline short_turn(Angle::from_degrees(50.0),
                                  {{0.01, 0.0, 0.0}, {0.04, 6.0, 6.0}, {1.2, 0.0, 0.0}});
  const std::string across = refusal_of([&] { return plates(short_turn, options, {0.4, 0.12, 4e-3}); });
  CHECK(across.find("flanges.section|section: angle stands across a bend, at 0 mm along the track|The flat "
                    "there is ") == 0);
  CHECK(across.find(" long, the leg 50 mm.|a narrower angle, section: flat, or floor: rolled\n") !=
        std::string::npos);
  options.flanges.width = 25e-3;
  options.flanges.thickness = 3e-3;
  options.flanges.bolt = 5;
  CHECK(refusal_of([&] { return plates(short_turn, options, {0.4, 0.12, 4e-3}); }) == "");
  // A crest that bends out of the gap within the leg.
  options = with_angles();
  const ClothoidSpline crest(Angle::from_degrees(20.0), {{1.0, -0.6, -0.6}, {1.0, -0.6, -0.6}});
  const std::string closed = refusal_of([&] { return plates(crest, options); });
  CHECK(closed.find("flanges.gap|gap: 0.5 mm is closed where the track bends") == 0);
  const std::size_t hint = closed.rfind("|gap: ");
  REQUIRE(hint != std::string::npos);
  options.flanges.gap = 1e-3 * std::stod(closed.substr(hint + 6));
  CHECK(closed.find(", or a narrower angle\n") != std::string::npos);
  CHECK(refusal_of([&] { return plates(crest, options); }) == "");
}

TEST_CASE("angle flanges: units of mitred tubes and troughs have room for the rings at both of their ends") {
  // Joints stand in the few tubes that are long enough: two of them came into one.
  int made = 0;
  for (const double straight : {0.15, 0.2, 0.25}) {
    for (const double curvature : {0.12, 0.2}) {
      const ClothoidSpline track(
          Angle::from_degrees(60.0),
          {{2.18, curvature, curvature}, {straight, 0.0, 0.0}, {3.0, 0.5 * curvature, 0.5 * curvature}});
      PlateOptions options = with_angles();
      options.flanges.width = 75e-3;
      options.flanges.thickness = 8e-3;
      options.split.longest = 0.8;
      options.round = RoundMake::mitred;
      options.bend = {FacetRule::segment_angle, 0.17 * curvature, {}, {}};
      CAPTURE(straight, curvature);
      const WorkshopBuild build = plates_of(track, section::HalfPipe{0.325, 0.083, 6e-3}, options);
      ++made;
      for (std::size_t i = 0; i + 1 < build.joints.size(); ++i)
        CHECK(build.joints[i + 1] - build.joints[i] > 2.0 * options.flanges.width);
    }
  }
  CHECK(made == 6);
}

}  // namespace angle_flanges_test
