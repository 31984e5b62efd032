// What is drawn on patterns beside their cuts lies on the plates: numbers, lines of rolls and bends.

#include "parts/shop/pattern_marks.hpp"

#include "glissade/drawing/drawing.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace glissade;
using namespace testing;

bool on_plate(const PlaneRegion& region, Vec2 point) {
  return contains(region.outline, point) &&
         std::none_of(region.cutouts.begin(), region.cutouts.end(),
                      [&](const ArcPath& cutout) { return contains(cutout, point); }) &&
         std::none_of(region.holes.begin(), region.holes.end(),
                      [&](const Circle& hole) { return norm(point - hole.centre) < hole.radius; });
}

/// Whether the strokes of a number are on the plate, by points along them: 0.2 mm apart or so.
bool number_is_on_plate(const FlatPattern& pattern, int number) {
  const std::string digits = (number < 10 ? "0" : "") + std::to_string(number);
  for (const ArcPath& stroke : stroked_text(digits, *pattern.number_at, pattern.number_height)) {
    for (const PathPiece& piece : pieces_of(stroke)) {
      for (double share = 0.0; share <= 1.0; share += 1.0 / 64.0) {
        if (!on_plate(pattern.region, point_on(piece, share))) return false;
      }
    }
  }
  return true;
}

/// How far lines of rolls and bends reach beyond the outline; along an edge is on it.
template <typename Line>
double beyond(const PlaneRegion& region, const std::vector<Line>& lines) {
  double most = 0.0;
  for (const Line& line : lines) {
    for (const Vec2 end : {line.from, line.to}) {
      if (contains(region.outline, end)) continue;
      double away = 1e9;
      for (const PathPiece& piece : pieces_of(region.outline))
        away = std::min(away, distance(PathPiece{end, end, 0.0}, piece));
      most = std::max(most, away);
    }
  }
  return most;
}

void check_marks(const WorkshopBuild& build) {
  std::size_t numbered = 0;
  std::size_t rolled = 0;
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.pattern) continue;
    CAPTURE(part.number, part.name);
    const FlatPattern& pattern = *part.pattern;
    CHECK(beyond(pattern.region, pattern.rolls) < 1e-6);
    CHECK(beyond(pattern.region, pattern.bends) < 1e-6);
    rolled += pattern.rolls.size() + pattern.bends.size();
    if (!pattern.number_at) continue;
    ++numbered;
    CHECK(number_is_on_plate(pattern, part.number));
  }
  CHECK(numbered > 0);
  CHECK(rolled > 0);
}

}  // namespace

TEST_CASE(
    "marks: numbers and lines of rolls and bends lie on the plates of channels, wherever openings are") {
  for (const WallSeat walls : {WallSeat::beside_floor, WallSeat::on_floor}) {
    for (const CornerJoint joint : {CornerJoint::butt, CornerJoint::lap, CornerJoint::tab_and_slot}) {
      PlateOptions options;
      options.split.longest = 1.6;
      options.walls = walls;
      options.corners.kind = joint;
      // In the middles of walls, where numbers stand.
      options.inspection = {{0.8}, {3.7}};
      options.liner.emplace();
      INFO("walls " << static_cast<int>(walls) << ", joint " << static_cast<int>(joint));
      check_marks(plates(chute(), options));
    }
  }
}

TEST_CASE("marks: lines of rolls end at the edges that are cut of plates that lean, thick ones too") {
  for (const double lean : {10.0, 25.0, 55.0}) {
    for (const double thickness : {3e-3, 10e-3}) {
      section::Trapezoid channel{WidthLaw(0.5), 0.3, Angle::from_degrees(lean), thickness};
      PlateOptions options;
      options.split.longest = 2.9;
      INFO(lean << " deg, " << thickness << " m");
      check_marks(plates_of(chute(), channel, options));
      options.floor = FloorMake::bent;
      check_marks(plates_of(chute(), channel, options));
    }
  }
}

TEST_CASE("marks: numbers keep clear of holes and cutouts at random, and fit where there is room") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t placed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const double width = random.between(0.03, 1.0);
    const double height = random.between(0.03, 0.4);
    FlatPattern pattern;
    pattern.region.outline = rectangle({}, {width, height});
    for (int k = 0; k < 6; ++k) {
      const Vec2 at{random.between(0.0, width), random.between(0.0, height)};
      const double radius = random.between(2e-3, 15e-3);
      if (k % 2 == 0)
        pattern.region.holes.push_back({at, radius});
      else
        pattern.region.cutouts.push_back(
            rectangle(at - Vec2{3.0 * radius, radius}, at + Vec2{3.0 * radius, radius}));
    }
    const int number = trial % 3 == 0 ? 7 : trial % 3 == 1 ? 44 : 188;
    parts::set_number_place(pattern, number);
    if (!pattern.number_at) continue;
    ++placed;
    CHECK(pattern.number_height >= 10e-3);
    CHECK(number_is_on_plate(pattern, number));
  }
  CHECK(placed > 200);
  // By hand: an opening in the middle leaves 60 mm above and below it.
  FlatPattern pattern;
  pattern.region.outline = rectangle({}, {1.0, 0.25});
  pattern.region.cutouts = {rectangle({0.4, 0.06}, {0.6, 0.19})};
  parts::set_number_place(pattern, 31);
  REQUIRE(pattern.number_at);
  CHECK(pattern.number_height == 20e-3);
  CHECK(number_is_on_plate(pattern, 31));
  // No plate is left round this one: no number rather than one in the scrap.
  pattern.region.cutouts = {rectangle({5e-3, 5e-3}, {0.995, 0.245})};
  parts::set_number_place(pattern, 31);
  CHECK_FALSE(pattern.number_at);
}

TEST_CASE("marks: a number stands beside bends where there is room, across them where there is none") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int trial = 0; trial < 100; ++trial) {
    const double width = random.between(0.3, 1.0);
    const double height = random.between(0.15, 0.4);
    FlatPattern pattern;
    pattern.region.outline = rectangle({}, {width, height});
    const bool along = trial % 2 == 0;
    // Two bends leave a strip of a third, or more, of the sheet.
    for (int k = 0; k < 2; ++k) {
      const double at = random.between(0.1, 0.9) * (along ? height : width);
      pattern.bends.push_back({along ? Vec2{0.0, at} : Vec2{at, 0.0},
                               along ? Vec2{width, at} : Vec2{at, height}, Angle::from_degrees(90.0), 2e-3,
                               true});
    }
    parts::set_number_place(pattern, 44);
    REQUIRE(pattern.number_at);
    const PlaneBox box{*pattern.number_at,
                       *pattern.number_at + pattern.number_height * Vec2{2.0 * 0.77, 1.0}};
    CAPTURE(trial, width, height, box.low.x, box.low.y);
    for (const BendLine& bend : pattern.bends) {
      const double from = along ? bend.from.y : bend.from.x;
      const double low = along ? box.low.y : box.low.x;
      const double high = along ? box.high.y : box.high.x;
      const double gap = std::max(low - from, from - high);
      // A right angle of 2 mm takes 3.1 mm of the sheet.
      CHECK(gap >= 0.25 * 3.14159 * 2e-3);
    }
  }
  FlatPattern narrow;
  narrow.region.outline = rectangle({}, {0.3, 0.05});
  for (int k = 0; k < 30; ++k)
    narrow.bends.push_back({{0.01 * k, 0.0}, {0.01 * k, 0.05}, Angle::from_degrees(5.0), 20e-3, true});
  parts::set_number_place(narrow, 44);
  CHECK(narrow.number_at);
}

TEST_CASE("marks: a line is clipped to its longest stretch on the plate; one along an edge or off it stays") {
  FlatPattern pattern;
  pattern.region.outline = {{{{0.0, 0.0}, 0.0}, {{1.0, -0.1}, 0.0}, {{1.0, 0.5}, 0.0}, {{0.0, 0.4}, 0.0}},
                            true};
  pattern.rolls = {{{0.0, -0.1}, {0.0, 0.5}, 2.0},
                   {{0.5, -0.1}, {0.5, 0.5}, 3.0},
                   {{0.5, 0.1}, {0.5, 0.3}, 3.0},
                   {{1.5, -0.1}, {1.5, 0.5}, 3.0}};
  parts::clip_lines(pattern);
  CHECK(norm(pattern.rolls[0].from - Vec2{0.0, 0.0}) < 1e-9);
  CHECK(norm(pattern.rolls[0].to - Vec2{0.0, 0.4}) < 1e-9);
  CHECK(norm(pattern.rolls[1].from - Vec2{0.5, -0.05}) < 1e-9);
  CHECK(norm(pattern.rolls[1].to - Vec2{0.5, 0.45}) < 1e-9);
  CHECK(pattern.rolls[2].from == Vec2{0.5, 0.1});
  CHECK(pattern.rolls[2].to == Vec2{0.5, 0.3});
  CHECK(pattern.rolls[3].from == Vec2{1.5, -0.1});
}
