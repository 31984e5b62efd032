// Tracks in timber: layers of the deck develop to the stock's length, seams are staggered and carried, parts add up.

#include "glissade/parts/timber.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/arc_path.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "parts/refusals.hpp"
#include "parts/supports/ground.hpp"
#include "parts/timber/timber_frame.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_rules.hpp"
#include "support/shortfalls.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace timber_test {

namespace {

using namespace glissade;

const Friction kFriction = Friction::from_angle(Angle::from_degrees(10.0));

/// Straight at 40 deg, a bend to 10 deg, straight again.
ArcSpline bend(double radius, double straight = 6.0) {
  const double steep = -40.0 * std::numbers::pi / 180.0;
  const double turn = 30.0 * std::numbers::pi / 180.0;
  const Vec2 first{straight * math::cos(steep), straight * math::sin(steep)};
  const Vec2 centre = first + radius * Vec2{-math::sin(steep), math::cos(steep)};
  const double flat = steep + turn;
  const Vec2 second = centre - radius * Vec2{-math::sin(flat), math::cos(flat)};
  const Vec2 third = second + straight * Vec2{math::cos(flat), math::sin(flat)};
  return ArcSpline(
      {{{{0.0, 0.0}, 0.0}, {first, math::tan(0.25 * turn)}, {second, 0.0}, {third, 0.0}}, false});
}

const section::Measures kRamp = section::Slab{WidthLaw(1.5), 24e-3, 0.15, 24e-3};

WorkshopBuild timber(const Centerline& track, const TimberOptions& options = {},
                     const section::Measures& measures = kRamp) {
  return make_timber(track, measures, {TimberOptions::kArcTolerance}, options, Placement(),
                     {.friction = kFriction});
}

std::string refusal(const TimberOptions& options, const Centerline& track,
                    const section::Measures& measures = kRamp) {
  return testing::refusal_of([&] { return timber(track, options, measures); });
}

std::vector<const ShopPart*> named(const WorkshopBuild& build, const std::string& start) {
  std::vector<const ShopPart*> parts;
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name.starts_with(start)) parts.push_back(&part);
  }
  return parts;
}

/// Pieces of all parts whose names begin so: equal ones share a number.
std::size_t pieces(const WorkshopBuild& build, const std::string& start) {
  std::size_t count = 0;
  for (const ShopPart* part : named(build, start)) count += part->quantity();
  return count;
}

std::size_t rows(const WorkshopBuild& build, const std::string& what) {
  return static_cast<std::size_t>(
      std::count_if(build.workshop.setting_out.begin(), build.workshop.setting_out.end(),
                    [&](const SettingOutPoint& row) { return row.what.starts_with(what); }));
}

}  // namespace

TEST_CASE(
    "timber: deck and curbs add up to the section's volume, and each layer is longer in a valley by t phi "
    "than the one above") {
  const ArcSpline track = bend(9.0);
  const WorkshopBuild build = timber(track);
  const double turn = 30.0 * std::numbers::pi / 180.0;
  const double length = track.length();
  const double deck = 1.548 * (24e-3 * length + 0.5 * 24e-3 * 24e-3 * turn);
  const double curbs = 2.0 * 24e-3 * (0.15 * length - 0.5 * 0.15 * 0.15 * turn);
  CHECK(std::fabs(build.proof.volume - deck - curbs) < 1e-12);
  // Two sheets side by side, in two layers of 12 mm whose middles lie 6 mm and 18 mm below the floor line.
  double flat = 0.0;
  for (const ShopPart* part : named(build, "deck_"))
    flat += 0.5 * static_cast<double>(part->quantity()) * bounds(part->pattern->region.outline).width();
  CHECK(flat == Approx(2.0 * length + 24e-3 * turn).epsilon(1e-12));
}

TEST_CASE(
    "timber: sheets keep the stock's length along their fibre, seams are staggered, and a cross member lies "
    "below each") {
  const WorkshopBuild build = timber(bend(9.0));
  for (const ShopPart* part : named(build, "deck_")) {
    const PlaneBox box = bounds(part->pattern->region.outline);
    CHECK(box.width() <= 2.5 + 1e-9);
    CHECK(box.height() <= 1.25 + 1e-9);
  }
  // Of the upper layer all but the last two are whole sheets.
  const auto upper = named(build, "deck_1_");
  for (std::size_t i = 0; i + 2 < upper.size(); ++i)
    CHECK(bounds(upper[i]->pattern->region.outline).width() == Approx(2.5).epsilon(1e-12));
  for (const ShopCheck& check : testing::shop_checks(build.workshop, "timber")) {
    INFO(check.rule << ": " << check.value << ", " << check.bound << ", " << check.where);
    CHECK(check.verdict == ShopVerdict::pass);
  }
}

TEST_CASE(
    "timber: cross members touch the deck in a hollow and hang below it on a crest, by the sagitta and no "
    "more than the fit") {
  for (const double radius : {5.0, 12.0}) {
    const ArcSpline track = bend(radius);
    const TimberOptions options;
    const parts::TimberJob job{track, *parts::timber_channel_of(kRamp), options, Placement()};
    const auto members = parts::cross_members(job, parts::deck_rows(job));
    double most = 0.0;
    for (const parts::CrossMember& member : members) most = std::max(most, member.sagitta);
    const double outer = radius + 24e-3;
    CHECK(most == Approx(outer - std::sqrt(outer * outer - 22.5e-3 * 22.5e-3)).epsilon(1e-3));
  }
  TimberOptions options;
  options.fit = 0.02e-3;
  const std::string text = refusal(options, bend(5.0));
  INFO(text);
  CHECK(text.starts_with("cross_members.width|width: cross members of 45 mm leave gaps of 0.0504 mm at "));
  CHECK(text.find("radius of 5 m; the fit is 0.02 mm") != std::string::npos);
  CHECK(text.find("narrower cross members, a larger fit") != std::string::npos);
}

TEST_CASE(
    "timber: ribs are cut from sheets with their joints half a rib apart, beams are set out with the levels "
    "of their edges") {
  const WorkshopBuild ribs = timber(bend(9.0));
  for (const ShopPart* part : named(ribs, "rib")) {
    const PlaneBox box = bounds(part->pattern->region.outline);
    CHECK(std::max(box.width(), box.height()) <= 2.49 + 1e-9);
    CHECK(std::min(box.width(), box.height()) <= 1.24 + 1e-9);
  }
  // Four of them: two with the joints, two with the shifted ones.
  CHECK(rows(ribs, "shifted joint ") == rows(ribs, "joint ") + 1);
  CHECK(pieces(ribs, "rib") == 2 * (rows(ribs, "joint ") + 1) + 2 * (rows(ribs, "shifted joint ") + 1));
  CHECK(!named(ribs, "splice").empty());

  TimberOptions options;
  options.frame = TimberFrame::beams;
  options.bearers.count = 5;
  const ArcSpline track = bend(40.0);
  const WorkshopBuild beams = timber(track, options, section::Slab{WidthLaw(2.6), 60e-3, 0.0, 0.0});
  CHECK(pieces(beams, "beam") == 3 * (rows(beams, "joint ") + 1) + 2 * (rows(beams, "shifted joint ") + 1));
  REQUIRE(beams.workshop.offset_names.size() == 3);
  for (const SettingOutPoint& point : beams.workshop.setting_out) {
    REQUIRE(point.offsets.size() == 3);
    const std::vector<double> depths = {60e-3, 60e-3 + 70e-3 + 2e-3, 60e-3 + 70e-3 + 2e-3 + 0.4};
    for (std::size_t i = 0; i < depths.size(); ++i) {
      INFO(point.what << ", " << beams.workshop.offset_names[i]);
      // Downhill the lines end square to the track, short of its finish.
      const CenterlinePoint finish = track.at(track.length());
      const double end = finish.x - depths[i] * math::sin(finish.slope_angle);
      CHECK(point.offsets[i].has_value() == (point.x < end));
      if (!point.offsets[i]) continue;
      double nearest = 1.0;
      for (int k = 0; k <= 20'000; ++k) {
        const CenterlinePoint at = track.at(std::min(track.length(), track.length() * k / 20'000.0));
        nearest = std::min(nearest, std::hypot(at.x - point.x, -at.drop - *point.offsets[i]));
      }
      CHECK(nearest == Approx(depths[i]).margin(1e-5));
    }
  }
  const std::vector<std::string>& notes = beams.workshop.notes;
  CHECK(std::count_if(notes.begin(), notes.end(), [](const std::string& note) {
          return note.starts_with("Ends of the underside of beams, run and z in mm: -341.");
        }) == 1);
}

TEST_CASE("timber: rows of legs that find no place are told, and so is where bearers lie on the ground") {
  TimberOptions options;
  options.legs = LegOptions{{{0.0, -8.0}}, 0.5, 90e-3};
  const section::Measures deck = section::Slab{WidthLaw(1.0), 24e-3, 0.0, 0.0};
  const ClothoidSpline steep(Angle::from_degrees(75.0), {{2.0, 0.0, 0.0}, {4.0, 0.25, 0.25}});
  const WorkshopBuild build = timber(steep, options, deck);
  const std::string told = testing::shortfall_of(build.workshop, "legs: ");
  INFO(told);
  CHECK(told.starts_with("legs|legs: "));
  CHECK(told.find(" rows find no place, at ") != std::string::npos);
  CHECK(told.find(
            " from the start along the run|None stands below bearers steeper than 68.8 deg: it would carry "
            "nothing.|a track that is less steep there, or a support of your own") != std::string::npos);
  // As many as are told are missing.
  const std::size_t of = told.find(" of ");
  const int missing = std::stoi(told.substr(std::string("legs|legs: ").size()));
  const int asked = std::stoi(told.substr(of + 4));
  CHECK(missing > 0);
  std::size_t rows = 0;
  for (const SettingOutPoint& point : build.workshop.setting_out) rows += point.what.starts_with("leg ");
  CHECK(static_cast<int>(rows) == asked - missing);
  const auto on_ground = [&](const WorkshopBuild& made) {
    return std::any_of(made.workshop.notes.begin(), made.workshop.notes.end(), [](const std::string& note) {
      return note.starts_with("No legs at ") &&
             note.ends_with("bearers lie on the ground there, or less than 50 mm above it.");
    });
  };
  CHECK_FALSE(on_ground(build));
  const ArcSpline track = bend(9.0);
  options.legs->spacing = 2.0;
  const WorkshopBuild free = timber(track, options);
  CHECK(testing::shortfall_of(free.workshop, "legs: ").empty());
  CHECK_FALSE(on_ground(free));
  // The ground just below the underside of the bearers at the finish.
  const parts::TrackFrame end = parts::frame_at(track, track.length());
  const double under = 24e-3 + 70e-3 + 2e-3 + 0.2;
  options.legs->ground = {{0.0, end.at.y - under * end.up.y - 20e-3}};
  CHECK(on_ground(timber(track, options)));
}

TEST_CASE("timber: bays of legs that no board braces are told, and no others") {
  // The ground falls as the track does: from a lower foot to an upper head it is too steep for one board.
  const double fall = std::tan(50.0 * std::numbers::pi / 180.0);
  const ClothoidSpline track(Angle::from_degrees(50.0), {{8.0, 0.0, 0.0}, {8.0, 0.06, 0.06}});
  TimberOptions options;
  options.legs = LegOptions{{{-2.0, 2.0 * fall - 2.1}, {5.5, -5.5 * fall - 2.1}, {30.0, -20.0}}, 2.0, 90e-3};
  const auto told = [&] {
    const WorkshopBuild build = timber(track, options);
    std::size_t boards = 0;
    for (const ShopPart* part : named(build, "long_brace_")) boards += part->quantity();
    return std::pair(testing::shortfall_of(build.workshop, "braced_from: "), boards);
  };
  const auto [text, few] = told();
  INFO(text);
  REQUIRE(text.starts_with("legs.braced_from|braced_from: no boards brace "));
  CHECK(text.find(" bays along the run, legs 1 to 2") != std::string::npos);
  CHECK(
      text.find(
          ", although a leg of each is 1.5 m long or longer|Between ground and bearers, 5 mm clear of both, "
          "boards of 120 mm (brace_width) find no room there, whichever way they rise.|another spacing of "
          "the "
          "legs, or bracing of your own") != std::string::npos);
  // Below level ground every bay has its boards.
  options.legs->ground = {{0.0, -14.0}};
  const auto [none, many] = told();
  CHECK(none.empty());
  CHECK(many > few);
}

TEST_CASE(
    "timber: legs reach from the ground to the underside of their bearer, and ground above it is refused "
    "with the place") {
  TimberOptions options;
  options.legs = LegOptions{{{0.0, -9.0}}, 2.0, 90e-3};
  const ArcSpline track = bend(9.0);
  const WorkshopBuild build = timber(track, options);
  const auto legs = named(build, "leg_");
  CHECK(legs.size() >= 7);
  for (const ShopPart* leg : legs) {
    CHECK(leg->places.front().origin.z >= -9.0 - 1e-9);
    CHECK(leg->bought_in);
    const PlaneBox box = bounds(leg->pattern->region.outline);  // lies along x, as wide as the post
    CHECK(box.height() == Approx(90e-3).epsilon(1e-9));
    CHECK(box.width() >= box.height());
  }
  // A second ground one metre up takes a metre off each leg.
  options.legs->ground = {{0.0, -8.0}};
  const WorkshopBuild higher = timber(track, options);
  REQUIRE(named(higher, "leg_").size() == legs.size());
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const double saved = legs[i]->volume - named(higher, "leg_")[i]->volume;
    CHECK(saved == Approx(90e-3 * 90e-3 * 1.0).epsilon(1e-9));
  }
  options.legs->ground = {{0.0, 0.0}};
  const std::string text = refusal(options, track);
  CHECK(text.starts_with("legs.ground|ground: it lies "));
  CHECK(text.find(" above the underside of the bearers, ") != std::string::npos);
  CHECK(text.find("a lower ground there") != std::string::npos);
}

TEST_CASE("timber: what no carpenter can make is refused with its key, all of it at once") {
  TimberOptions options;
  options.deck.layers = 0;
  options.bearers.count = 1;
  options.cross_members.spacing = 10e-3;
  std::string text = refusal(options, bend(9.0));
  CHECK(text.find("deck.layers|layers: 0 layers|They are 1 to 12.") != std::string::npos);
  CHECK(text.find("bearers.count|count: 1 bearers carry no deck") != std::string::npos);
  CHECK(text.find("cross_members.spacing|spacing: 10 mm is less than 1.5 widths") != std::string::npos);
  text = refusal({}, bend(9.0), section::Pipe{0.15, 4e-3});
  CHECK(text ==
        "cross_section.kind|fabrication: this pipe cannot be made of timber|Timber makes slabs, u-channels, "
        "trapezoids, half-pipes and v-channels of one width.|one of them, with one width\n");
  options = {};
  options.bearers.depth = 2.6;
  text = refusal(options, bend(9.0));
  CHECK(text ==
        "bearers.depth|depth: bearers of 2.6 m fit no stock|A sheet is 2.5 m x 1.25 m.|a smaller depth, a "
        "larger "
        "sheet, or frame: beams\n");
}

TEST_CASE("timber: random bends, widths and layers clash nowhere and keep their volumes") {
  testing::Random random = testing::seeded_random();
  for (int k = 0; k < 6; ++k) {
    INFO("GLISSADE_SEED=" << random.seed() << ", problem " << k);
    const ArcSpline track = bend(random.between(4.0, 60.0), random.between(3.0, 12.0));
    const double thickness = random.between(15e-3, 60e-3);
    const section::Measures measures =
        k % 2 == 0 ? section::Measures(section::Slab{WidthLaw(random.between(0.8, 3.0)), thickness, 0.0, 0.0})
                   : section::Measures(section::UChannel{WidthLaw(random.between(0.8, 3.0)), 0.4, thickness});
    TimberOptions options;
    options.deck.layers = random.integer(1, 4);
    options.frame = k % 3 == 0 ? TimberFrame::beams : TimberFrame::ribs;
    const WorkshopBuild build = timber(track, options, measures);
    CHECK(build.proof.volume == Approx(build.proof.exact_volume).epsilon(1e-9));
    CHECK(build.proof.smallest_gap >= 0.0);
    CHECK(build.proof.edge_mismatch <= 1e-9);
    CHECK(build.ride.arrives);
  }
}

TEST_CASE("timber: long legs are braced across and along, boards end on the legs, and short ones are told") {
  TimberOptions options;
  options.legs = LegOptions{{{0.0, -9.0}}, 2.0, 90e-3};
  const ArcSpline track = bend(9.0);
  const WorkshopBuild build = timber(track, options);
  const auto check = testing::check_of(testing::shop_checks(build.workshop, "timber"), "timber.brace");
  CHECK(check.verdict == ShopVerdict::pass);  // those that are left are short
  const auto rows = named(build, "cross_brace_");
  const auto bays = named(build, "long_brace_");
  CHECK(rows.size() > 4);
  CHECK(bays.size() > 4);
  for (const ShopPart* board : rows) {
    INFO(board->name);
    REQUIRE(board->quantity() % 2 == 0);
    const Prism& body = std::get<Prism>(board->body);
    const PlaneBox box = bounds(body.region.outline);
    // From the middle of the outer legs, 45 mm inwards of their faces: 1.5 m and two curbs less two half legs.
    CHECK(box.width() == Approx(1.5 + 2 * 24e-3 - 18e-3 + 0.9 * 90e-3).epsilon(1e-12));
    CHECK(body.depth == 24e-3);
    const Vec3 low = board->places.front().to_space({0.0, 0.0, 0.0});
    const Vec3 other = board->places[1].to_space({0.0, 0.0, 0.0});
    CHECK(low.y == Approx(-other.y).epsilon(1e-12));
    CHECK(std::fabs(low.x - other.x) == Approx(90e-3).epsilon(1e-9));
    CHECK(low.z == Approx(other.z).epsilon(1e-12));
    CHECK(board->mass == Approx(420.0 * board->volume).epsilon(1e-12));
  }
  // Ground that falls with the track leaves the other diagonal alone.
  options.legs->ground = {{0.0, -2.5}, {4.6, -6.4}, {8.9, -8.6}, {15.0, -9.8}};
  const WorkshopBuild slope = timber(track, options);
  CHECK(named(slope, "cross_brace_").size() > 1);
  CHECK(named(slope, "long_brace_").size() > 1);
  options.legs->ground = {{0.0, -9.0}};
  // Without braces the longest legs are told.
  options.legs->braced_from = 100.0;
  const WorkshopBuild bare = timber(track, options);
  CHECK(named(bare, "cross_brace_").empty());
  CHECK(named(bare, "long_brace_").empty());
  const auto told = testing::check_of(testing::shop_checks(bare.workshop, "timber"), "timber.brace");
  CHECK(told.verdict == ShopVerdict::warn);
  CHECK(told.bound == "at most 1.5 m");
}

TEST_CASE(
    "timber: a leg that would stand beyond the line of the ground is refused, told from where to where") {
  const ArcSpline track = bend(20.0, 6.0);
  TimberOptions options;
  options.legs = LegOptions{{{-5.0, -16.0}, {3.0, -16.0}}, 2.0, 90e-3};
  const std::string text = refusal(options, track);
  // A line as long as the track will do, where legs stand behind its start below a slope.
  options.legs->ground = {{0.0, -16.0}, {40.0, -16.0}};
  CHECK(refusal(options, track).empty());
  CHECK(text.find(
            "legs.ground|ground: its line ends 3 m from the start along the run, and a leg stands at ") == 0);
  CHECK(text.find("a line as far as ") != std::string::npos);
}

TEST_CASE("timber: on a slope legs and boards stay above the ground, feet are level on its highest point") {
  const ArcSpline track = bend(20.0, 6.0);
  for (const double grade : {-0.5, -0.25, 0.3}) {
    INFO("grade " << grade);
    TimberOptions options;
    // A hump between the rows, too.
    options.legs = LegOptions{{{-5.0, -16.0 - 5.0 * grade},
                               {6.0, -16.0 + 6.0 * grade},
                               {6.9, -15.2 + 6.9 * grade},
                               {8.0, -16.0 + 8.0 * grade},
                               {40.0, -16.0 + 40.0 * grade}},
                              2.0,
                              90e-3};
    const WorkshopBuild build = timber(track, options);
    const std::vector<Vec2>& ground = options.legs->ground;
    double least = 1.0;
    double foot = 1.0;
    for (const ShopPart& part : build.workshop.parts) {
      const bool leg = part.name.starts_with("leg");
      if (!leg && part.name.find("brace") == std::string::npos) continue;
      const auto& prism = std::get<Prism>(part.body);
      for (const Frame& place : part.places) {
        for (const PathPiece& edge : pieces_of(prism.region.outline)) {
          for (const double z : {0.0, prism.depth}) {
            for (double share = 0.0; share <= 1.0; share += 0.02) {
              const Vec2 at = point_on(edge, share);
              const Vec3 corner = place.to_space({at.x, at.y, z});
              const double above = corner.z - parts::ground_at(ground, corner.x);
              least = std::min(least, above);
              if (leg) foot = std::min(foot, above);
            }
          }
        }
      }
    }
    CHECK_FALSE(named(build, "cross_brace_").empty());
    CHECK_FALSE(named(build, "long_brace_").empty());
    CHECK(least > -1e-9);
    CHECK(std::fabs(foot) < 1e-9);
  }
}

TEST_CASE("timber: boards of narrow and steep ramps keep below the bearers and off the ground") {
  testing::Random random = testing::seeded_random();
  for (int k = 0; k < 6; ++k) {
    INFO("GLISSADE_SEED=" << random.seed() << ", problem " << k);
    // Boards of a narrow row stand steep; beside its legs the bearers of a steep track lie lower than above them.
    const ArcSpline track = bend(random.between(9.0, 30.0), random.between(4.0, 8.0));
    TimberOptions options;
    options.frame = k % 2 == 0 ? TimberFrame::beams : TimberFrame::ribs;
    options.legs = LegOptions{{{0.0, random.between(-18.0, -12.0)}}, 2.0, 90e-3};
    options.legs->brace_thickness = random.between(24e-3, 60e-3);
    const section::Slab narrow{WidthLaw(random.between(0.3, 0.6)), 24e-3, 0.0, 0.0};
    const WorkshopBuild build = timber(track, options, narrow);  // proves that nothing clashes
    CHECK_FALSE(named(build, "cross_brace_").empty());
    for (const ShopPart* board : named(build, "cross_brace_")) {
      const PlaneBox box = bounds(std::get<Prism>(board->body).region.outline);
      for (const Frame& place : board->places)
        CHECK(place.to_space({box.low.x, box.low.y, 0.0}).z > options.legs->ground.front().y);
    }
  }
}

TEST_CASE(
    "timber: a deck of boards adds up to the section less its gaps, and seams of neighbours are apart") {
  for (const double gap : {0.0, 5e-3}) {
    TimberOptions options;
    options.deck.boards = BoardOptions{120e-3, 4.0, gap};
    const ArcSpline track = bend(9.0);
    const WorkshopBuild build = timber(track, options);
    const double overall = 1.5 + 2 * 24e-3;
    const int count = static_cast<int>(std::ceil((overall + gap) / (120e-3 + gap)));
    const double turned = 30.0 * std::numbers::pi / 180.0;
    const double length = build.master.spline->length();
    const double deck = (overall - gap * (count - 1)) * (24e-3 * length + 0.5 * 24e-3 * 24e-3 * turned);
    double made = 0.0;
    std::vector<double> across;  // of boards that begin with the track
    for (const ShopPart* board : named(build, "board_")) {
      made += board->volume * static_cast<double>(board->quantity());
      CHECK(board->material == "C24");
      CHECK(bounds(board->pattern->region.outline).width() <= 4.0 + 1e-9);
      CHECK(bounds(board->pattern->region.outline).height() <= 120e-3 + 1e-12);
      for (const Frame& place : board->places) {
        if (std::fabs(place.origin.x) < 20e-3 && place.origin.z > -12e-3) across.push_back(place.origin.y);
      }
    }
    CHECK(made == Approx(deck).epsilon(1e-6));  // the track's arcs turn by that to rounding
    const double ripped = (overall - gap * (count - 1)) / count;
    const std::string note = "Boards of 120 mm are ripped to " + length_text(ripped, 5) + ": " +
                             std::to_string(count) + " of them lie side by side.";
    const auto& notes = build.workshop.notes;
    CHECK(std::find(notes.begin(), notes.end(), note) != notes.end());
    CHECK(across.size() == static_cast<std::size_t>(count));
    const auto checks = testing::shop_checks(build.workshop, "timber");
    CHECK(testing::check_of(checks, "timber.seam-stagger").verdict == ShopVerdict::pass);
    CHECK(testing::check_of(checks, "timber.seam-support").verdict == ShopVerdict::pass);
    CHECK(testing::check_of(checks, "timber.board-radius").value == "9 m");
    CHECK(testing::check_of(checks, "timber.deck-radius").rule.empty());
  }
}

TEST_CASE("timber: curbs are cut from the sheet, however high and bent, or refused with its key") {
  const section::Measures high = section::Slab{WidthLaw(1.5), 24e-3, 1.0, 24e-3};
  const WorkshopBuild build = timber(bend(4.0), {}, high);
  for (const ShopPart* part : named(build, "curb_")) {
    const PlaneBox box = bounds(part->pattern->region.outline);
    CHECK(std::max(box.width(), box.height()) <= 2.49 + 1e-9);
    CHECK(std::min(box.width(), box.height()) <= 1.24 + 1e-9);
  }
  CHECK(refusal({}, bend(4.0), section::Slab{WidthLaw(1.5), 24e-3, 2.6, 24e-3}) ==
        "split.sheet|sheet: curbs of 2.6 m fit no sheet of 2.5 m x 1.25 m|Each takes its height and what its "
        "curve "
        "rises, 5 mm from the edges.|a larger sheet, lower curbs, or ones of more than 50 mm, which are "
        "sawn\n");
}

TEST_CASE("timber: sheets and curbs get shorter until none is heavier than allowed; bearers keep apart") {
  TimberOptions options;
  options.split.heaviest = 12.0;
  const ArcSpline track = bend(9.0);
  const WorkshopBuild build = timber(track, options);
  const auto check = testing::check_of(testing::shop_checks(build.workshop, "timber"), "timber.mass");
  CHECK(check.verdict == ShopVerdict::pass);
  options.split.heaviest = 1.0;
  const std::string heavy = refusal(options, track);
  CHECK(heavy.starts_with("split.heaviest|heaviest: 1 kg is a sheet of the deck of "));
  CHECK(heavy.find("|a larger mass, more layers, or a narrower sheet") != std::string::npos);
  options.split.heaviest.reset();
  options.bearers.count = 60;
  const std::string many = refusal(options, track);
  CHECK(many.starts_with("bearers.count|count: 60 bearers on a width of 1.548 m stand 25.9 mm apart|"));
  CHECK(many.find("|at most 29 of them") != std::string::npos);
  options.bearers.count = 29;
  CHECK_NOTHROW(timber(track, options));
}

TEST_CASE("timber: the table of setting out has every joint of every bearer, and every leg with its foot") {
  TimberOptions options;
  options.legs = LegOptions{{{0.0, -9.0}}, 2.0, 90e-3};
  const WorkshopBuild build = timber(bend(9.0), options);
  CHECK(pieces(build, "rib_") == 2 * (rows(build, "joint ") + 1) + 2 * (rows(build, "shifted joint ") + 1));
  CHECK(rows(build, "shifted joint ") == rows(build, "joint ") + 1);
  CHECK(4 * rows(build, "leg ") == pieces(build, "leg_"));
  double last = -1.0;
  for (const SettingOutPoint& row : build.workshop.setting_out) {
    CHECK(row.arc_length >= last);
    last = row.arc_length;
    REQUIRE(row.offsets.size() == 3);
  }
}

TEST_CASE("timber: whatever the slopes of both ends, every row of legs is set out where its legs stand") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t before = 0;
  std::size_t behind = 0;
  for (int trial = 0; trial < 8; ++trial) {
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double first = random.between(-30.0, 10.0) * kDegree;
    const double last = random.between(-10.0, 30.0) * kDegree;
    const Vec2 middle = random.between(3.0, 5.0) * Vec2{math::cos(first), math::sin(first)};
    const Vec2 end = random.between(3.0, 5.0) * Vec2{math::cos(last), math::sin(last)};
    // A corner is no track: an arc that touches both lines, with tangents of 2 m.
    const Vec2 in = middle - (2.0 / norm(middle)) * middle;
    const Vec2 out = middle + (2.0 / norm(end)) * end;
    const ArcSpline track(
        {{{{0.0, 0.0}, 0.0}, {in, math::tan(0.25 * (last - first))}, {out, 0.0}, {middle + end, 0.0}},
         false});
    TimberOptions options;
    options.legs = LegOptions{{{0.0, -6.0}}, random.between(1.0, 2.0), 90e-3};
    const WorkshopBuild build = timber(track, options);
    std::vector<double> stands;
    for (const ShopPart* part : named(build, "leg_")) {
      const PlaneBox box = bounds(part->pattern->region.outline);
      for (const Frame& place : part->places) {
        const Vec3 low = place.origin + box.low.x * place.x + box.low.y * place.y;
        const Vec3 high = place.origin + box.high.x * place.x + box.high.y * place.y;
        stands.push_back(0.5 * (low.x + high.x));
      }
    }
    CHECK(stands.size() == 4 * rows(build, "leg "));
    for (const SettingOutPoint& row : build.workshop.setting_out) {
      if (!row.what.starts_with("leg ")) continue;
      INFO(row.what << " of " << row.site.x << ", " << track.at(track.length()).x);
      CHECK(std::count_if(stands.begin(), stands.end(),
                          [&](double x) { return std::fabs(x - row.site.x) < 1e-9; }) >= 4);
      CHECK(row.x == row.site.x);
      CHECK(row.what.find("middle x " + rounded_text(row.x * 1e3, 6) + ", foot z ") != std::string::npos);
      CHECK(row.beyond_track == (row.x < 0.0 || row.x > track.at(track.length()).x));
      before += row.x < 0.0 ? 1U : 0U;
      if (row.beyond_track) {
        behind += row.x > 0.0 ? 1U : 0U;
        CHECK(row.z == Approx(-6.0).margin(1e-12));
        CHECK(row.site.z == row.z);
        CHECK(std::none_of(row.offsets.begin(), row.offsets.end(),
                           [](const std::optional<double>& level) { return level.has_value(); }));
      } else {
        CHECK(row.z == Approx(-track.at(row.arc_length).drop).margin(1e-12));
        CHECK(row.x == Approx(track.at(row.arc_length).x).margin(1e-9));
      }
    }
  }
  CHECK(before > 0);
  CHECK(behind > 0);
}

}  // namespace timber_test
