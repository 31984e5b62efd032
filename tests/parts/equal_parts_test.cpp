// Equal parts get one number, however they lie; what differs, or is formed the other way, gets its own.

#include "parts/shop/equal_parts.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/math.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_edges.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace glissade;
using namespace testing;

/// A region that no turn and no mirror brings onto itself.
PlaneRegion lopsided() {
  PlaneRegion region;
  region.outline = {{{{0.0, 0.0}, 0.1}, {{0.5, 0.02}, 0.0}, {{0.45, 0.2}, -0.2}, {{0.02, 0.15}, 0.0}}, true};
  region.cutouts = {rectangle({0.1, 0.06}, {0.14, 0.09})};
  region.holes = {{{0.3, 0.1}, 5e-3}, {{0.35, 0.12}, 5e-3}};
  return region;
}

ShopPart flat_plate(PlaneRegion region) {
  ShopPart part = shop_part(1, "plate", Prism{region, 4e-3});
  part.pattern.emplace();
  part.pattern->region = std::move(region);
  parts::weigh(part);
  return part;
}

ShopPart formed(PartBody body, FlatPattern pattern) {
  ShopPart part = shop_part(1, "formed", std::move(body));
  part.pattern = std::move(pattern);
  parts::weigh(part);
  return part;
}

/// The same outline from another corner on, the other way round.
PlaneRegion rewritten(PlaneRegion region) {
  std::vector<PathVertex>& corners = region.outline.vertices;
  std::rotate(corners.begin(), corners.begin() + 2, corners.end());
  region.outline = reversed(region.outline);
  std::swap(region.holes.front(), region.holes.back());
  return region;
}

/// How far points of one part, placed in another, lie off the depth that they have in their own.
double misfit(const ShopPart& part, const ShopPart& other, const Frame& place) {
  constexpr double kInset = 1e-4;
  double worst = 0.0;
  for (const Vec3 point : parts::edge_points(part.body, kInset)) {
    const double own = parts::depth_inside(part.body, point);
    worst = std::max(worst, std::fabs(own - parts::depth_inside(other.body, place.to_space(point))));
  }
  return worst;
}

double handedness(const Frame& place) {
  return dot(place.x, Vec3{place.y.y * place.z.z - place.y.z * place.z.y,
                           place.y.z * place.z.x - place.y.x * place.z.z,
                           place.y.x * place.z.y - place.y.y * place.z.x});
}

std::size_t pieces_named(const WorkshopBuild& build, const std::string& word) {
  std::size_t pieces = 0;
  for (const ShopPart* part : named(build, word)) pieces += part->quantity();
  return pieces;
}

}  // namespace

TEST_CASE(
    "equal parts: a flat plate is found turned, moved and turned over, to where each of its points lies") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const ShopPart plate = flat_plate(lopsided());
  for (int run = 0; run < 40; ++run) {
    PlaneMotion motion =
        PlaneMotion::turn(random.between(-3.0, 3.0), {random.between(-2.0, 2.0), random.between(-2.0, 2.0)});
    motion.mirrored = run % 2 == 1;
    const ShopPart other = flat_plate(rewritten(moved(lopsided(), motion)));
    const auto place = parts::place_in(plate, other);
    REQUIRE(place);
    CHECK(misfit(plate, other, *place) < 3e-9);
    CHECK(std::fabs(handedness(*place) - 1.0) < 1e-12);
    CHECK(place->z.z == (motion.mirrored ? -1.0 : 1.0));
  }
}

TEST_CASE(
    "equal parts: a hole, a bulge, a corner, the material or the thickness that differs makes another part") {
  const ShopPart plate = flat_plate(lopsided());
  const auto apart = [&](auto change) {
    PlaneRegion region = lopsided();
    change(region);
    return !parts::place_in(plate, flat_plate(region)).has_value();
  };
  CHECK(apart([](PlaneRegion& region) { region.holes[1].centre.x += 2e-6; }));
  CHECK(apart([](PlaneRegion& region) { region.holes[1].radius += 2e-6; }));
  CHECK(apart([](PlaneRegion& region) { region.outline.vertices[0].bulge += 1e-4; }));
  CHECK(apart([](PlaneRegion& region) { region.outline.vertices[2].at.y += 5e-6; }));
  CHECK(apart([](PlaneRegion& region) { region.cutouts.front().vertices[1].at.x += 5e-6; }));
  CHECK(apart([](PlaneRegion& region) { region.holes.pop_back(); }));
  CHECK_FALSE(apart([](PlaneRegion& region) { region.holes[1].centre.x += 1e-8; }));
  for (const bool material : {true, false}) {
    ShopPart other = plate;
    (material ? other.material : other.name) = "X5CrNi18-10";
    CHECK(parts::place_in(plate, other).has_value() == !material);
    other.thickness += 1e-3;
    CHECK_FALSE(parts::place_in(plate, other));
  }
}

TEST_CASE(
    "equal parts: mirror images that are bent or lean are two parts, and so is one bent the other way") {
  const ArcPath path{{{{0.0, 0.0}, 0.1}, {{1.0, 0.0}, 0.0}, {{1.5, -0.2}, 0.0}}, false};
  const std::vector<Vec2> section = {{0.0, 0.0}, {0.2, 0.05}, {0.2, 0.054}, {0.0, 0.004}};
  std::vector<Vec2> mirrored;
  for (auto corner = section.rbegin(); corner != section.rend(); ++corner)
    mirrored.push_back({corner->x, -corner->y});
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {1.5, 0.2});
  const ShopPart left = formed(SweptBody{path, section}, pattern);
  const ShopPart right = formed(SweptBody{path, mirrored}, pattern);
  CHECK(parts::place_in(left, left));
  CHECK_FALSE(parts::place_in(left, right));
  CHECK(parts::mirror_images(left, right));
  // The same way along a path that is its own mirror image: turned end for end, the left wall is the right one.
  const ArcPath even{{{{0.0, 0.0}, 0.1}, {{1.0, 0.0}, 0.0}}, false};
  const ShopPart here = formed(SweptBody{even, section}, pattern);
  const ShopPart there = formed(SweptBody{even, mirrored}, pattern);
  const auto place = parts::place_in(here, there);
  REQUIRE(place);
  CHECK(misfit(here, there, *place) < 3e-9);
  CHECK(std::fabs(handedness(*place) - 1.0) < 1e-12);

  FlatPattern up = pattern;
  up.bends = {{{0.5, 0.0}, {0.5, 0.2}, Angle::from_degrees(5.0), 4e-3, true}};
  FlatPattern down = up;
  down.bends.front().up = false;
  const Prism side{{rectangle({}, {1.5, 4e-3}), {}, {}}, 0.2};
  CHECK(parts::place_in(formed(side, up), formed(side, up)));
  CHECK_FALSE(parts::place_in(formed(side, up), formed(side, down)));
}

TEST_CASE(
    "equal parts: sheets with slots and gores lie where they lay, end for end where that is the same piece") {
  const ShopPart sheet = [&] {
    FlatPattern pattern;
    const RolledSheet body = slotted_floor();
    pattern.region = body.region;
    return formed(body, pattern);
  }();
  const auto same = parts::place_in(sheet, sheet);
  REQUIRE(same);
  CHECK(*same == Frame{});
  FlatPattern pattern;
  pattern.region = lopsided();
  FlatPattern turned;
  turned.region = moved(lopsided(), PlaneMotion::turn(std::numbers::pi, {1.0, 1.0}));
  const Angle one = Angle::from_degrees(3.0);
  const Angle other = Angle::from_degrees(-5.0);
  const ShopPart tube = formed(TubeGore{0.1, 3e-3, 0.4, one, other}, pattern);
  const ShopPart back = formed(TubeGore{0.1, 3e-3, 0.4, -other, -one}, turned);
  const auto place = parts::place_in(tube, back);
  REQUIRE(place);
  CHECK(misfit(tube, back, *place) < 3e-9);
  // Its seam on the other side: another tube.
  CHECK_FALSE(parts::place_in(tube, formed(TubeGore{0.1, 3e-3, 0.4, -other, -one}, pattern)));
}

TEST_CASE("equal parts: a straight chute in even units is a few parts, of which there are many") {
  PlateOptions options;
  options.split.longest = 2.0;
  options.liner.emplace();
  options.liner->tile_length = 0.5;
  options.rim.emplace();
  options.inspection = {{4.6, 0.2, 0.12, 8}};
  const StraightLine line(Endpoints{6.4, 4.8});
  const WorkshopBuild build = plates(line, options);
  CHECK(named(build, "wall").size() == 2);  // plain, and with an opening
  CHECK(named(build, "left_wall").front()->quantity() == 1);
  CHECK(pieces_named(build, "wall") == 8);
  CHECK(named(build, "floor").size() <= 2);  // holes of tiles, shifted in every second course
  CHECK(pieces_named(build, "floor") == 4);
  CHECK(named(build, "rim").size() == 1);
  CHECK(pieces_named(build, "rim") == 8);
  // Beside a wall that leans the other one is the same plate, end for end.
  const WorkshopBuild leaning =
      plates_of(line, section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(25.0), 4e-3}, [&] {
        PlateOptions plain;
        plain.split.longest = 2.0;
        return plain;
      }());
  CHECK(named(leaning, "wall").size() == 1);
  CHECK(named(leaning, "wall").front()->name == "wall_1");
  CHECK(pieces_named(leaning, "wall") == 8);
}

TEST_CASE("equal parts: along one arc units are alike, and parts add up and clear one another as they lie") {
  const ClothoidSpline arc(Angle::from_degrees(50.0), {{6.0, 0.1, 0.1}});
  PlateOptions options;
  options.split.longest = 1.5;
  const WorkshopBuild channel = plates(arc, options);
  CHECK(named(channel, "wall").size() == 1);
  CHECK(named(channel, "floor").size() == 1);
  CHECK(channel.workshop.bends.size() == 1);
  const WorkshopBuild leaning =
      plates_of(arc, section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(25.0), 4e-3}, options);
  CHECK(named(leaning, "wall").size() == 1);
  CHECK(pieces_named(leaning, "wall") == 8);
  PlateOptions mitred = options;
  mitred.bend = {FacetRule::bends, 12.0, {}, {}};
  const WorkshopBuild pipe = plates_of(arc, section::Pipe{0.2, 3e-3}, mitred);
  CHECK(named(pipe, "tube").size() < 6);
  CHECK(pieces_named(pipe, "tube") > 12);
}

TEST_CASE("equal parts: what is formed as a mirror image is told") {
  const WorkshopBuild build =
      plates_of(chute(), section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(25.0), 4e-3});
  const std::vector<std::string>& notes = build.workshop.notes;
  CHECK(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
    return note.find("are mirror images: blanks alike, turned over, and formed the other way.") !=
           std::string::npos;
  }));
}
