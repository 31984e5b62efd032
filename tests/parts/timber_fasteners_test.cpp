// What holds timber together: screws deep enough and short enough, as many as spacings ask for.

#include "parts/timber/timber_fasteners.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/parts/timber.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shortfalls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace timber_fasteners_test {

namespace {

using namespace glissade;
using parts::screw_for;
using parts::screws_across;

const Friction kFriction = Friction::from_angle(Angle::from_degrees(10.0));

/// Straight on a slope of three in four.
ArcSpline slope(double length) {
  return ArcSpline({{{{0.0, 0.0}, 0.0}, {{0.8 * length, -0.6 * length}, 0.0}}, false});
}

WorkshopBuild timber(const TimberOptions& options, const section::Measures& measures, double length = 5.0) {
  return make_timber(slope(length), measures, {TimberOptions::kArcTolerance}, options, Placement(),
                     {.friction = kFriction});
}

std::size_t count_of(const WorkshopBuild& build, const std::string& start, const std::string& where) {
  std::size_t count = 0;
  for (const BoughtInItem& item : build.workshop.items) {
    if (item.name.starts_with(start) && item.where.find(where) != std::string::npos) count += item.quantity;
  }
  return count;
}

std::size_t pieces_of(const WorkshopBuild& build, const std::string& start) {
  std::size_t count = 0;
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name.starts_with(start)) count += part.quantity();
  }
  return count;
}

}  // namespace

TEST_CASE("screws: as thick as what they fix asks for, six diameters deep, and never through") {
  CHECK(screw_for({12e-3, 12e-3, 70e-3, 30e-3}).name() == "screw 4 x 40");
  CHECK(screw_for({18e-3, 18e-3, 70e-3, 30e-3}).name() == "screw 5 x 50");
  CHECK(screw_for({39e-3, 78e-3, 120e-3, 30e-3}).name() == "screw 6 x 120");
  // 12.5 mm from an edge no thicker than 4 mm, 22.5 mm no thicker than 6 mm.
  CHECK(screw_for({39e-3, 39e-3, 120e-3, 12.5e-3}).diameter == 4);
  CHECK(screw_for({72e-3, 72e-3, 200e-3, 22.5e-3}).name() == "screw 6 x 120");
  // A thin member holds what it can.
  CHECK(screw_for({18e-3, 18e-3, 18e-3, 18e-3}).name() == "screw 4 x 30");
  testing::Random random = testing::seeded_random();
  for (int k = 0; k < 400; ++k) {
    const double fixed = random.between(6e-3, 0.15);
    const parts::ScrewedJoint joint{fixed, fixed * random.integer(1, 3), random.between(10e-3, 0.4),
                                    random.between(5e-3, 60e-3)};
    const parts::Screw screw = screw_for(joint);
    INFO("GLISSADE_SEED=" << random.seed() << ", joint " << k << ": " << screw.name());
    CHECK(screw.length < joint.through + joint.into);
    CHECK((screw.diameter == 4 || 3e-3 * screw.diameter <= joint.edge + 1e-9));
    // Deeper, thicker members never take a shorter one.
    parts::ScrewedJoint deeper = joint;
    deeper.into *= 2.0;
    CHECK(screw_for(deeper).length >= screw.length - 1e-9);
  }
}

TEST_CASE("screws: a row has one in a slat, two in a board, more in a sheet by the spacing") {
  CHECK(screws_across(40e-3, 0.3) == 1);
  CHECK(screws_across(120e-3, 0.3) == 2);
  CHECK(screws_across(0.35, 0.3) == 2);
  CHECK(screws_across(0.36, 0.3) == 3);
  CHECK(screws_across(1.25, 0.15) == 9);
}

TEST_CASE(
    "timber: sheets are screwed to every cross member, closer where they end, on both sides of a seam") {
  TimberOptions options;
  options.deck.layers = 1;
  const WorkshopBuild build = timber(options, section::Slab{WidthLaw(1.2), 18e-3, 0.0, 0.0});
  const std::size_t members = pieces_of(build, "cross_member");
  const std::size_t sheets = pieces_of(build, "deck_");
  REQUIRE(sheets == 2);
  // Across 1.2 m: 5 in the field, 9 at the ends; the seam's member has both.
  CHECK(count_of(build, "screw 4 x 45", "sheets to cross members") == 5 * (members - 3) + 9 * 4);
  // On ribs, which are too narrow for screws from above, brackets.
  CHECK(count_of(build, "angle bracket", "cross members on bearers") == 3 * members);
  CHECK(count_of(build, "screw", "curbs") == 0);
}

TEST_CASE("timber: two screws a board and cross member, curbs from below, beams from above") {
  TimberOptions options;
  options.frame = TimberFrame::beams;
  options.bearers.count = 2;
  options.deck = {1, 2e-3, BoardOptions{120e-3, 6.0, 0.0}};
  const WorkshopBuild build = timber(options, section::Slab{WidthLaw(1.104), 30e-3, 0.2, 48e-3});
  const std::size_t members = pieces_of(build, "cross_member");
  // Ten side by side; every other one has a seam.
  REQUIRE(pieces_of(build, "board_") == 15);
  CHECK(count_of(build, "screw", "boards to cross members") == 2 * 10 * members + 2 * 5);
  CHECK(count_of(build, "screw 6 x 120", "two askew") == 2 * 2 * members);
  CHECK(count_of(build, "screw 6 x 70", "curbs") > 0);
}

TEST_CASE("timber: legs have heads and feet, every board of theirs two bolts with two large washers each") {
  TimberOptions options;
  options.legs = LegOptions{{{0.0, -8.0}}, 2.0, 90e-3};
  const WorkshopBuild build = timber(options, section::Slab{WidthLaw(1.2), 24e-3, 0.0, 0.0}, 9.0);
  const std::size_t legs = pieces_of(build, "leg_");
  const std::size_t boards = pieces_of(build, "cross_brace_") + pieces_of(build, "long_brace_");
  REQUIRE(boards > 4);
  CHECK(count_of(build, "pair of head plates", "") == legs);
  CHECK(count_of(build, "post base", "") == legs);
  // 90 + 24 mm of timber, two washers of 3 mm, a nut, two threads.
  CHECK(count_of(build, "bolt M10 x 140", "") == 2 * boards);
  CHECK(count_of(build, "nut M10", "") == 2 * boards);
  CHECK(count_of(build, "large washer M10", "") == 4 * boards);
  // Texts that a column of the drawings holds at full height.
  for (const BoughtInItem& item : build.workshop.items) {
    INFO(item.name << ", " << item.where);
    CHECK(item.name.size() <= 24);
    CHECK(item.where.size() <= 34);
  }
}

namespace {

/// The longer side of the narrowest strip round an outline, by turning it.
double board_length(const ArcPath& outline) {
  double narrowest = 1e9;
  double length = 0.0;
  for (int k = 0; k < 3600; ++k) {
    const double angle = k * std::numbers::pi / 3600.0;
    const Vec2 way{std::cos(angle), std::sin(angle)};
    Vec2 low{1e9, 1e9};
    Vec2 high{-1e9, -1e9};
    for (const PathVertex& vertex : outline.vertices) {
      const Vec2 turned{dot(vertex.at, way), cross(way, vertex.at)};
      low = {std::min(low.x, turned.x), std::min(low.y, turned.y)};
      high = {std::max(high.x, turned.x), std::max(high.y, turned.y)};
    }
    if (high.y - low.y >= narrowest) continue;
    narrowest = high.y - low.y;
    length = high.x - low.x;
  }
  return length;
}

}  // namespace

TEST_CASE("timber: legs and boards longer than lumber comes are told, however they lie, and no others") {
  std::size_t boards = 0;
  for (const double longest : {1.2, 1.5, 1.7, 2.1, 4.0, 9.0}) {
    CAPTURE(longest);
    TimberOptions options;
    options.legs = LegOptions{{{0.0, -8.0}}, 2.0, 90e-3};
    options.split.longest = longest;
    const WorkshopBuild build = timber(options, section::Slab{WidthLaw(1.2), 24e-3, 0.0, 0.0}, 9.0);
    const std::string note = testing::shortfall_of(build.workshop, "longest: ");
    for (const ShopPart& part : build.workshop.parts) {
      if (!part.stands) continue;
      const double length = board_length(part.pattern->region.outline);
      if (std::fabs(length - longest) < 2e-3) continue;  // as near as turning by steps tells
      const bool told = note.find(" " + part.name + " (") != std::string::npos;
      CAPTURE(part.name, length, note);
      CHECK(told == (length > longest));
      const bool brace = part.name.find("brace") != std::string::npos;
      if (brace && told) ++boards;
    }
    if (longest < 9.0) {
      CHECK(note.starts_with("split.longest|longest: "));
      CHECK(note.find(" longer than " + length_text(longest) + ", and to be spliced|") != std::string::npos);
      // A stock as long as is told does.
      const std::string key = "|longest: ";
      options.split.longest = std::stod(note.substr(note.rfind(key) + key.size()));
      CHECK(testing::shortfall_of(
                timber(options, section::Slab{WidthLaw(1.2), 24e-3, 0.0, 0.0}, 9.0).workshop, "longest: ")
                .empty());
    }
  }
  CHECK(boards > 10);
}

TEST_CASE("timber troughs: every strip is screwed to every template below it") {
  TimberOptions options;
  options.deck.layers = 2;
  const WorkshopBuild build =
      timber(options, section::Trapezoid{WidthLaw(0.4), 0.2, Angle::from_degrees(25.0), 24e-3}, 2.0);
  const std::size_t templates = pieces_of(build, "template");
  // Across the floor 3 screws, at its ends 4; across each wall 2, at its ends and on both sides of its seam 3.
  REQUIRE(pieces_of(build, "floor_layer_1") == 1);
  REQUIRE(pieces_of(build, "left_wall_layer_1") + pieces_of(build, "wall_layer_1") == 4);
  CHECK(count_of(build, "screw", "strips of layer 1 to templates") ==
        3 * (templates - 2) + 4 * 2 + 2 * (2 * (templates - 3) + 3 * 4));
  CHECK(count_of(build, "angle bracket", "templates on bearers") > 0);
}

}  // namespace timber_fasteners_test
