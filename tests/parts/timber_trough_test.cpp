// Trapezoids, half-pipes and V-channels in timber: strips that develop, templates that carry them, seams above templates.

#include "parts/timber/timber_trough.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/arc_path.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/parts/timber.hpp"
#include "glissade/section/cross_section.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/refusals.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_rules.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace timber_trough_test {

namespace {

using namespace glissade;

constexpr double kTurn = 30.0 * std::numbers::pi / 180.0;

/// Straight at 35 deg, a bend to 5 deg, straight again; `sense` -1: a crest from 5 deg to 35 deg.
ArcSpline bend(double radius, double straight = 4.0, double sense = 1.0) {
  const double first = -(sense > 0.0 ? 35.0 : 5.0) * std::numbers::pi / 180.0;
  const double second = first + sense * kTurn;
  const auto way = [](double angle) { return Vec2{math::cos(angle), math::sin(angle)}; };
  const auto left = [](double angle) { return Vec2{-math::sin(angle), math::cos(angle)}; };
  const Vec2 one = straight * way(first);
  const Vec2 two = one + sense * radius * (left(first) - left(second));
  return ArcSpline({{{{0.0, 0.0}, 0.0},
                     {one, sense * math::tan(0.25 * kTurn)},
                     {two, 0.0},
                     {two + straight * way(second), 0.0}},
                    false});
}

const section::Measures kTrapezoid = section::Trapezoid{WidthLaw(1.0), 0.4, Angle::from_degrees(25.0), 24e-3};
const section::Measures kHalfPipe = section::HalfPipe{0.9, 0.15, 18e-3};
const section::Measures kVee = section::VChannel{Angle::from_degrees(100.0), 0.2, 0.4, 24e-3};

WorkshopBuild timber(const Centerline& track, const section::Measures& measures,
                     const TimberOptions& options = {}) {
  return make_timber(track, measures, {TimberOptions::kArcTolerance}, options, Placement(),
                     {.friction = Friction::from_angle(Angle::from_degrees(3.0)), .entry_speed = 1.0});
}

std::string refusal(const Centerline& track, const section::Measures& measures,
                    const TimberOptions& options = {}) {
  return testing::refusal_of([&] { return timber(track, measures, options); });
}

const ShopPart& part_of(const WorkshopBuild& build, const std::string& name) {
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name == name) return part;
  }
  throw std::runtime_error("no part " + name);
}

bool is_lining(const ShopPart& part) {
  return part.name.starts_with("stave") || part.name.starts_with("floor") ||
         part.name.find("wall") != std::string::npos;
}

/// @return distance of a point from the nearest strip; negative inside one
double distance_to_lining(const WorkshopBuild& build, Vec3 point) {
  double nearest = 1.0;
  for (const ShopPart& strip : build.workshop.parts) {
    if (!is_lining(strip)) continue;
    for (const Frame& there : strip.places) {
      const Vec3 away = point - there.origin;
      nearest = std::min(nearest, -parts::depth_inside(strip.body, {dot(away, there.x), dot(away, there.y),
                                                                    dot(away, there.z)}));
    }
  }
  return nearest;
}

void check_rules(const WorkshopBuild& build) {
  const auto checks = testing::shop_checks(build.workshop, "timber");
  for (const char* rule :
       {"timber.seam-support", "timber.seam-stagger", "timber.deck-gap", "timber.member-length"}) {
    INFO(rule << ": " << testing::check_of(checks, rule).value << ", "
              << testing::check_of(checks, rule).where);
    CHECK(testing::check_of(checks, rule).verdict == ShopVerdict::pass);
  }
}

}  // namespace

TEST_CASE("timber troughs: strips add up to A S - M phi of the section, whatever stands in them") {
  for (const double sense : {1.0, -1.0}) {
    const ArcSpline track = bend(9.0, 4.0, sense);
    const WorkshopBuild build = timber(track, kTrapezoid);
    const CrossSection section(kTrapezoid);
    const double wanted = section.area() * track.length() - sense * section.first_moment() * kTurn;
    CHECK(build.proof.volume == Approx(wanted).epsilon(1e-9));
    double listed = 0.0;
    Vec3 moment;
    for (const ShopPart& part : build.workshop.parts) {
      if (!is_lining(part)) continue;
      const parts::BodyMoments own = parts::moments(part.body);
      for (const Frame& place : part.places) moment = moment + own.volume * place.to_space(own.centroid);
      listed += part.volume * static_cast<double>(part.quantity());
    }
    CHECK(listed == Approx(wanted).epsilon(1e-9));
    // Pieces that share a number lie on both sides alike.
    CHECK(std::fabs(moment.y) < 1e-9);
    check_rules(build);
  }
}

TEST_CASE(
    "timber troughs: a wall that leans b develops along a radius of R / cos b, the floor to a rectangle") {
  const double radius = 9.0;
  TimberOptions options;
  options.deck.layers = 1;
  const WorkshopBuild build = timber(bend(radius), kTrapezoid, options);
  double longest = 0.0;
  double found = 0.0;
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.name.starts_with("left_wall")) continue;
    for (const PathPiece& piece : pieces_of(part.pattern->region.outline)) {
      if (piece.straight() || length(piece) <= longest) continue;
      longest = length(piece);
      found = arc_of(piece).radius;
    }
  }
  // The mitre's foot in the middle of the thickness lies half a floor below the line; its edge is the longer one.
  const double upright = math::cos(25.0 * std::numbers::pi / 180.0);
  CHECK(found == Approx((radius + 12e-3) / upright).epsilon(1e-7));
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.name.starts_with("floor")) continue;
    for (const PathPiece& piece : pieces_of(part.pattern->region.outline))
      CHECK(std::fabs(piece.bulge) < 1e-9);
  }
}

TEST_CASE(
    "timber troughs: staves lie outside the round by no more than their tolerance, and fewer do for more of "
    "it") {
  std::size_t before = 1000;
  for (const double tolerance : {1e-3, 4e-3, 16e-3}) {
    TimberOptions options;
    options.deck.stave_tolerance = tolerance;
    const auto channel = parts::timber_channel_of(kHalfPipe, options);
    REQUIRE(channel);
    const auto& plates = channel->trough->section.plates;
    double most = 0.0;
    for (const parts::SectionPlate& plate : plates) {
      for (const Vec2 corner : {plate.face_from, plate.face_to}) {
        if (corner.y < 0.45) most = std::max(most, norm(corner - Vec2{0.0, 0.45}) - 0.45);
      }
    }
    CHECK(most <= tolerance * (1.0 + 1e-9));
    CHECK(plates.size() < before);
    before = plates.size();
  }
}

TEST_CASE("timber troughs: the lining touches every template or hangs above it by no more than the fit") {
  int combination = 0;
  for (const section::Measures& measures : {kTrapezoid, kHalfPipe, kVee}) {
    for (const double sense : {1.0, -1.0}) {
      INFO(section::kind(measures) << " " << sense);
      // Each bent one way, elsewhere than in CI.
      const int number = combination++;
      if (!testing::thorough() && number % 2 != number / 2 % 2) continue;
      const TimberOptions options;
      const WorkshopBuild build = timber(bend(3.0, 3.0, sense), measures, options);
      const ShopPart& part = part_of(build, "template");
      const auto channel = parts::timber_channel_of(measures, options);
      const Vec2 corner{-0.5 * channel->overall(), -channel->thickness - options.cross_members.height};
      const std::vector<Vec2>& seat = channel->trough->seat;
      double least = 1.0;
      double most = 0.0;
      for (const Frame& place : part.places) {
        for (std::size_t i = 1; i + 1 < seat.size(); ++i) {
          for (const double z : {0.0, 0.5 * part.thickness, part.thickness}) {
            const Vec2 at = seat[i] - corner;
            const double gap = distance_to_lining(build, place.to_space({at.x, at.y, z}));
            least = std::min(least, gap);
            most = std::max(most, gap);
          }
        }
      }
      CHECK(least > -1e-6);
      CHECK(least < 1e-6);
      CHECK(most <= options.fit);
    }
  }
}

TEST_CASE("timber troughs: strips are cut from the stock, a template lies below every seam") {
  for (const bool boards : {false, true}) {
    TimberOptions options;
    if (boards) options.deck = {1, 2e-3, BoardOptions{140e-3, 3.0, 3e-3}};
    const WorkshopBuild build = timber(bend(9.0), kVee, options);
    for (const ShopPart& part : build.workshop.parts) {
      if (!is_lining(part)) continue;
      INFO(part.name);
      const PlaneBox box = bounds(part.pattern->region.outline);
      CHECK(box.width() <= (boards ? 3.0 : 2.49) + 1e-9);
      CHECK(box.height() <= (boards ? 0.14 : 1.24) + 1e-9);
      CHECK(part.material == (boards ? "C24" : "birch plywood"));
      CHECK(part.thickness == Approx(boards ? 24e-3 : 12e-3));
    }
    check_rules(build);
  }
}

TEST_CASE(
    "timber troughs: sides that mitres make wider on the back are cut into boards of the width that is "
    "there") {
  int combination = 0;
  for (const double width : {80e-3, 95e-3, 120e-3}) {
    for (const double thickness : {24e-3, 36e-3, 54e-3}) {
      // Each width with one thickness, elsewhere than in CI.
      const int number = combination++;
      if (!testing::thorough() && number % 3 != number / 3) continue;
      INFO(width << " m, " << thickness << " m");
      TimberOptions options;
      options.deck = {2, 2e-3, BoardOptions{width, 4.0, 0.0}};
      // As wide as asks for whole boards, so that nothing is left for the mitres.
      const section::Trapezoid section{WidthLaw(0.85 * 5.0 * width), 0.85 * 3.0 * width,
                                       Angle::from_degrees(10.0), thickness};
      const WorkshopBuild build = timber(bend(12.0), section, options);
      for (const ShopPart& part : build.workshop.parts) {
        if (is_lining(part)) CHECK(bounds(part.pattern->region.outline).height() <= width + 1e-9);
      }
    }
  }
}

TEST_CASE("timber troughs: what cannot be made is refused with its key, value, bound and a way out") {
  const ArcSpline track = bend(9.0);
  TimberOptions options;
  options.split.sheet = {1.25, 0.6};
  CHECK(refusal(track, kTrapezoid, options) ==
        "split.sheet|sheet: templates of 1.546 m x 494 mm fit no sheet of 1.25 m x 600 mm|Each is cut in one "
        "piece, 5 mm from the edges; it reaches up to the rim, or to cross_members.reach.|a sheet of at "
        "least 1.557 m x "
        "504 mm, or a narrower section\n");
  options.split.sheet = {2.5, 0.4};
  const std::string high = refusal(track, kTrapezoid, options);
  CHECK(high.find("|a sheet of at least ") != std::string::npos);
  CHECK(high.ends_with(", or cross_members: {reach: 296 mm}\n"));
  options.cross_members.reach = 0.296;
  CHECK(parts::lining_problems(*parts::timber_channel_of(kTrapezoid, options), options).empty());
  options = {};
  options.deck.boards = BoardOptions{16e-3, 4.0, 0.0};
  std::string text = refusal(bend(3.0), kTrapezoid, options);
  INFO(text);
  CHECK(text.starts_with("deck.boards|the "));
  CHECK(text.find(" wide, is cut from no board of 4 m x 16 mm at ") != std::string::npos);
  options = {};
  options.deck.stave_tolerance = 1e-7;
  text = refusal(track, kHalfPipe, options);
  CHECK(text.starts_with("deck.stave_tolerance|stave_tolerance: 0.0001 mm takes staves of "));
  // What it proposes will do.
  const double proposed = std::stod(text.substr(text.rfind("stave_tolerance: ") + 17)) * 1e-3;
  options.deck.stave_tolerance = proposed;
  CHECK(parts::lining_problems(*parts::timber_channel_of(kHalfPipe, options), options).empty());
  options = {};
  options.cross_members.reach = -0.1;
  text = refusal(track, kHalfPipe, options);
  CHECK(text.starts_with("cross_members.reach|reach: -100 mm is no height above the floor|"));
  text = refusal(track, section::TrackGroove{WidthLaw(0.6), 0.135, 0.03, 0.32, 0.05});
  CHECK(text.starts_with("cross_section.kind|fabrication: this track-groove cannot be made of timber|"));
  // A hollow tighter than the walls are high.
  text = refusal(bend(0.3), kTrapezoid);
  INFO(text);
  CHECK(text.find("folds over at ") != std::string::npos);
}

TEST_CASE("timber troughs: random sections and bends clash nowhere and keep volume, seams and sizes") {
  testing::Random random = testing::seeded_random();
  const int problems = testing::thorough() ? 6 : 4;  // each kind once at least
  for (int k = 0; k < problems; ++k) {
    INFO("GLISSADE_SEED=" << random.seed() << ", problem " << k);
    const double thickness = random.between(12e-3, 36e-3);
    const double width = random.between(0.3, 1.2);
    section::Measures measures = section::HalfPipe{width, random.between(0.0, 0.3), thickness};
    if (k % 3 == 1) {
      measures = section::Trapezoid{WidthLaw(width), random.between(0.1, 0.6),
                                    Angle::from_degrees(random.between(2.0, 60.0)), thickness};
    } else if (k % 3 == 2) {
      measures = section::VChannel{Angle::from_degrees(random.between(60.0, 150.0)), 0.2,
                                   random.between(0.3, 0.6), thickness};
    }
    TimberOptions options;
    options.deck.layers = random.integer(1, 3);
    options.deck.stave_tolerance = 4e-3;
    options.frame = k % 2 == 0 ? TimberFrame::beams : TimberFrame::ribs;
    options.split.sheet = {6.0, 3.0};
    const WorkshopBuild build = timber(
        bend(random.between(4.0, 30.0), random.between(2.0, 5.0), k < 3 ? 1.0 : -1.0), measures, options);
    CHECK(build.proof.volume == Approx(build.proof.exact_volume).epsilon(1e-9));
    CHECK(build.proof.edge_mismatch <= 1e-9);
    CHECK(build.proof.smallest_gap >= 0.0);
    CHECK(build.ride.arrives);
    check_rules(build);
  }
}

}  // namespace timber_trough_test
