// Liners by wear, with what they lose and the spares that they take, and rides of a fed stream as it is built.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/bodies/facets.hpp"
#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace glissade;
using namespace testing;

/// In units of 2.9 m, with tiles of their own material.
PlateOptions lined() {
  PlateOptions options;
  options.split.longest = 2.9;
  options.liner.emplace();
  options.liner->material = {"400 HB", 7900.0};
  return options;
}

}  // namespace

TEST_CASE(
    "liner: where it is worn tiles wear, elsewhere plain ones are as thick; the same holes, weights by "
    "material") {
  const PlateOptions whole = lined();
  PlateOptions worn = whole;
  worn.liner->where = LinerPlaces::worn;
  worn.liner->worn_from = 0.6;
  worn.liner->life = 1000.0 * 3600.0;
  const double length = chute().length();
  // A hump of wear in the middle: above 0.6 of the peak from 0.4 to 0.6 of the length.
  worn.floor_wear = {{0.0, 0.2, 1e-10},
                     {0.4 * length, 0.6, 1e-9},
                     {0.5 * length, 1.0, 4e-9},
                     {0.6 * length, 0.6, 1e-9},
                     {length, 0.0, 1e-10}};
  const WorkshopBuild plain = plates(chute(), whole);
  const WorkshopBuild build = plates(chute(), worn);
  CHECK(build.proof.volume == Approx(plain.proof.volume).epsilon(1e-9));
  CHECK(build.proof.smallest_gap == Approx(plain.proof.smallest_gap).margin(1e-9));
  std::size_t tiles = 0;
  double wearing = 0.0;
  std::vector<std::string> spare;
  for (const ShopPart* part : named(build, "tile_")) {
    const bool wears = part->name.find("plain_") != 0;
    CHECK(part->material == (wears ? "400 HB" : "S235"));
    CHECK(part->mass == Approx(part->volume * (wears ? 7900.0 : 7850.0)).epsilon(1e-12));
    tiles += part->places.size();
    if (wears) wearing += part->volume * static_cast<double>(part->places.size());
  }
  std::size_t all = 0;
  for (const ShopPart* part : named(plain, "tile_")) all += part->places.size();
  CHECK(tiles == all);
  // The worn fifth of the track, and up to a course at either end.
  const double floor = 0.4 * 6e-3 * length;
  CHECK(wearing > 0.2 * floor * 0.97);
  CHECK(wearing < (0.2 + 2.0 * 0.6 / length) * floor);
  // The course over the peak loses 4e-9 m/s: 6 mm in 416.7 h, so that 1000 h take two sets more.
  // Courses whose tiles are alike share numbers: two sets of the one over the peak, one or none of those beside it.
  double most = 0.0;
  for (const BoughtInItem& item : build.workshop.items) {
    if (item.name.find("spare tile_") != 0) continue;
    CHECK(item.where == "liner, within 1000 h");
    const std::string name = item.name.substr(6, item.name.find(',') - 6);
    const std::vector<const ShopPart*> tile = named(build, name);
    REQUIRE(!tile.empty());
    most =
        std::max(most, static_cast<double>(item.quantity) / static_cast<double>(tile.front()->places.size()));
  }
  CHECK(most > 1.0);
  CHECK(most <= 2.0);
  double least = 1e9;
  for (const ShopMeasurement& measured : build.workshop.measured) {
    if (measured.quantity == "liner_life_share") least = std::min(least, measured.value);
  }
  CHECK(least == Approx(6e-3 / 4e-9 / (1000.0 * 3600.0)).epsilon(1e-9));
  const auto& notes = build.workshop.notes;
  const auto says = [&](const std::string& words) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(words) != std::string::npos; });
  };
  CHECK(says("Tiles of 400 HB lie where the floor wears 60 % of its peak or more"));
  CHECK(says("for 1000 h without an exchange it takes 14.4 mm."));
  CHECK_FALSE(says("  "));
}

TEST_CASE(
    "liner: of a wear that is even, or asked for in all, every tile wears; shares and lives have bounds") {
  PlateOptions options = lined();
  options.liner->where = LinerPlaces::worn;
  options.floor_wear = {{0.0, 1.0, 0.0}, {10.0, 1.0, 0.0}};
  CHECK(named(plates(chute(), options), "plain_tile_").empty());
  options.liner->worn_from = 0.0;
  CHECK(refusal(options).find("liner.worn_from|worn_from: 0 % is out of range|It is a share") == 0);
  options.liner->worn_from = 0.5;
  options.liner->life = -1.0;
  CHECK(refusal(options).find("liner.life|life is not positive") == 0);
  options.liner->life = 3600.0;
  options.liner->tonnage = 1e6;
  CHECK(refusal(options).find("liner.tonnage|tonnage beside life") == 0);
}

TEST_CASE("as built: a body that falls on its floor meets an impact once, not at each joint") {
  PlateOptions options;
  options.split.longest = 1.5;
  const CoulombBrachistochrone track = chute();
  Body body{.friction = kFriction};
  body.landing = Landing{4.0, Angle::from_degrees(85.0)};
  const WorkshopBuild build = make_plates(track, kChannel, {1e-4}, options, Placement(), body);
  REQUIRE(build.joints.size() > 4);
  CHECK(build.ride.exit_speed == Approx(build.ride.design_exit_speed).epsilon(1e-3));
  CHECK(build.ride.travel_time == Approx(build.ride.design_travel_time).epsilon(1e-3));
}

TEST_CASE("as built: what changes along the track changes where it does, whatever units there are") {
  const ClothoidSpline track(Angle::from_degrees(55.0), {{2.0, 0.0, 0.0}, {3.0, 0.1, 0.1}, {2.5, 0.0, 0.0}});
  PlateOptions options;
  options.split.longest = 1.3;
  // Of a stream the width, which makes it deep; of a body the friction, twice within the first units.
  StreamShape shape;
  shape.mass_flow = 60.0;
  shape.bulk_density = 750.0;
  shape.width = WidthLaw({{1.0, 0.5}, {3.0, 0.25}, {4.0, 0.25}, {6.0, 0.5}});
  Body stream{.friction = kFriction, .entry_speed = 2.0};
  stream.law = std::make_shared<const BulkStream>(shape);
  Body body{.friction = kFriction};
  body.friction_changes = {{0.4, Friction::from_coefficient(0.2)},
                           {0.9, Friction::from_coefficient(0.35)},
                           {5.0, Friction::from_coefficient(0.25)}};
  for (const Body& one : {stream, body}) {
    const WorkshopBuild build =
        make_plates(track, section::UChannel{shape.width, 0.25, 4e-3}, {1e-4}, options, Placement(), one);
    REQUIRE(build.joints.size() > 5);
    REQUIRE(build.ride.arrives);
    CHECK(build.ride.exit_speed == Approx(build.ride.design_exit_speed).epsilon(1e-4));
    CHECK(build.ride.travel_time == Approx(build.ride.design_travel_time).epsilon(1e-4));
  }
  // The rest of a law is the law.
  const BulkStream law(shape);
  const LawPtr rest = law.from(3.4);
  REQUIRE(rest);
  for (const double s : {0.0, 0.3, 0.7, 2.0, 4.0})
    CHECK(rest->resistance(s, 9.0).factor == Approx(law.resistance(3.4 + s, 9.0).factor).epsilon(1e-12));
  shape.width = WidthLaw(0.4);
  CHECK(BulkStream(shape).from(1.0) == nullptr);
}

TEST_CASE(
    "as built: a start that leans over by a hair is fallen off and met again, and costs nothing to speak "
    "of") {
  const auto ride = [](double beyond) {
    // An arc of 5 m from the vertical, or beyond, to 20 deg.
    const double turn = Angle::from_degrees(70.0).radians() + beyond;
    const double heading = -Angle::from_degrees(90.0).radians() - beyond;
    const Vec2 chord{std::cos(heading + 0.5 * turn), std::sin(heading + 0.5 * turn)};
    const ArcPath path{{{{0.0, 0.0}, bulge_of_sweep(turn)}, {10.0 * std::sin(0.5 * turn) * chord, 0.0}},
                       false};
    return parts::ride_lines({std::make_shared<ArcSpline>(path)}, {.friction = kFriction}, kDefaultGravity,
                             0.0);
  };
  const parts::FacetRide upright = ride(0.0);
  REQUIRE(upright.arrives);
  for (const double beyond : {1e-6, 1e-4, 1e-3}) {
    const parts::FacetRide over = ride(beyond);
    INFO(over.stopped);
    REQUIRE(over.arrives);
    CHECK(over.speed == Approx(upright.speed).epsilon(3.0 * beyond + 1e-6));
    CHECK(over.time == Approx(upright.time).epsilon(0.1 * std::sqrt(beyond) + 1e-4));
  }
}

TEST_CASE(
    "liner: holes of tiles keep the distances that the rules of the shop ask for, in tiles of every size") {
  int combination = 0;
  for (const double length : {0.07, 0.13, 0.3}) {
    PlateOptions options;
    options.liner.emplace();
    options.liner->tile_length = length;
    options.liner->tile_width = 0.2;
    options.split.longest = 2.5;
    options.flanges.width = 0.07;
    for (const bool own : {false, true}) {
      // Each size with one of the two in turn, elsewhere than in CI.
      const int number = combination++;
      if (!testing::thorough() && number % 2 != number / 2 % 2) continue;
      if (own) options.shop = {.hole_edge_diameters = 2.5, .hole_pitch_diameters = 4.0};
      const WorkshopBuild build = plates(chute(), options);
      INFO("tiles of " << length << (own ? ", own rules" : ""));
      for (const ShopPart* tile : named(build, "tile_")) {
        const PlaneBox box = bounds(tile->pattern->region.outline);
        const std::vector<Circle>& holes = tile->pattern->region.holes;
        REQUIRE(!holes.empty());
        for (const Circle& hole : holes) {
          const double edge = std::min({hole.centre.x - box.low.x, box.high.x - hole.centre.x,
                                        hole.centre.y - box.low.y, box.high.y - hole.centre.y});
          // A floor of arcs is a little longer at its middle than on its face.
          CHECK(edge > 0.995 * options.shop.hole_edge_diameters * 2.0 * hole.radius);
          for (const Circle& other : holes) {
            if (&other == &hole) continue;
            CHECK(norm(other.centre - hole.centre) > 0.995 * options.shop.hole_pitch_diameters * 12e-3);
          }
        }
      }
    }
  }
}

TEST_CASE("liner: tiles thinner than the heads of their bolts are refused, with what would do") {
  PlateOptions options = lined();
  const auto told = [&](double thickness, int bolt) {
    options.liner->thickness = thickness;
    options.liner->bolt = bolt;
    return refusal(options);
  };
  const std::string why =
      "Tiles are held by countersunk bolts (ISO 10642), whose heads must not jut out of their faces.|";
  CHECK(told(2e-3, 16) == "liner.thickness|thickness: 2 mm is less than the heads of M16 are high, 8.8 mm|" +
                              why + "a thickness of 8.8 mm or more\n");
  CHECK(told(5e-3, 12) == "liner.thickness|thickness: 5 mm is less than the heads of M12 are high, 7.44 mm|" +
                              why + "bolt: M8, or a thickness of 7.44 mm or more\n");
  CHECK(told(12e-3, 24) ==
        "liner.bolt|bolt: M24 has no countersunk head|Tiles are held by countersunk bolts, and ISO 10642 "
        "ends at "
        "M20.|a bolt of M5 to M20\n");
  // What is told to try does, and so does the least of each size.
  CHECK(told(8.8e-3, 16).empty());
  CHECK(told(5e-3, 8).empty());
  CHECK(told(LinerOptions().thickness, LinerOptions().bolt).empty());
  CHECK(told(6.2e-3, 10).empty());
  CHECK_FALSE(told(6e-3, 10).empty());
}
