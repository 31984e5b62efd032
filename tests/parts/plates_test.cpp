// Channels as plates: what is cut adds up to the channel, fits its sheet, and is ridden as it is built.

#include "glissade/parts/plates.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include "parts/bodies/clash.hpp"
#include "parts/bodies/facets.hpp"
#include "parts/chute_plates.hpp"
#include "parts/curves/offset_line.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shortfalls.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace {

using namespace glissade;
using namespace testing;

double sum_of_volumes(const Workshop& workshop) {
  double sum = 0.0;
  for (const ShopPart& part : workshop.parts) sum += part.volume * static_cast<double>(part.quantity());
  return sum;
}

}  // namespace

TEST_CASE(
    "plates: with nothing told there are frames that fit low walls, and plates that fit narrow outlines") {
  const auto frame_of = [](double height) {
    const WorkshopBuild build = plates_of(chute(), section::UChannel{WidthLaw(0.15), height, 2e-3});
    const std::vector<const ShopPart*> frames = named(build, "end_frame");
    std::string noted;
    for (const std::string& note : build.workshop.notes) {
      if (note.starts_with("Frames are")) noted = note;
    }
    if (noted.empty()) noted = shortfall_of(build.workshop, "flanges: ");
    return std::pair(frames.empty() ? 0.0 : frames.front()->thickness, noted);
  };
  CHECK(frame_of(0.1) == std::pair(6e-3, std::string()));
  CHECK(frame_of(0.045) ==
        std::pair(6e-3, std::string("Frames are 40 mm wide, with M8: the usual ones find no "
                                    "room beside walls of 45 mm.")));
  CHECK(frame_of(0.022).first == 4e-3);
  CHECK(frame_of(0.005).second ==
        "flanges|flanges: no frames at the ends of units, which are to be welded|None finds room beside "
        "walls of 5 mm: the "
        "narrowest are 14 mm wide, with M5.|flanges: none if that is meant, or higher walls");
  // What is told is refused where it does not fit.
  PlateOptions told;
  told.flanges.as_told = true;
  CHECK(refusal_of([&] {
          return plates_of(chute(), section::UChannel{WidthLaw(0.15), 0.045, 2e-3}, told);
        }).find("flanges.width|width: 50 mm is more than the walls are high, 45 mm") == 0);

  const section::TrackGroove groove{WidthLaw(0.1), 0.01, 6e-3, 0.03, 0.012};
  const WorkshopBuild thin = plates_of(chute(), groove);
  CHECK(thin.workshop.parts.front().thickness < 4e-3);
  CHECK(thin.workshop.parts.front().thickness >= 0.5e-3);
}

TEST_CASE("plates: the grain chute's floor and walls add up to the volume of its channel, A S - M phi") {
  PlateOptions options;
  options.flanges.wanted = false;
  const WorkshopBuild build = plates(chute(), options);
  const double t = kChannel.thickness;
  const double wall = kChannel.wall_height + t;
  const double area = kChannel.width * t + 2.0 * t * wall;
  const double first =
      -0.5 * kChannel.width * t * t + t * (kChannel.wall_height * kChannel.wall_height - t * t);
  const ArcSpline& line = *build.master.spline;
  const double turned = line.slope_angle(0.0) - line.slope_angle(line.length());
  const double exact = area * line.length() - first * turned;
  CHECK(std::fabs(sum_of_volumes(build.workshop) / exact - 1.0) < kPartsVolumeAccuracy);
  CHECK(std::fabs(build.proof.volume / exact - 1.0) < kPartsVolumeAccuracy);
  // Two sums of the same parts, in other orders.
  CHECK(std::fabs(build.proof.added_volume) < 1e-14 * exact);
  CHECK(build.proof.edge_mismatch < 1e-9);
}

TEST_CASE("plates: seats of the walls change parts, not the channel") {
  PlateOptions beside;
  beside.flanges.wanted = false;
  PlateOptions on = beside;
  on.walls = WallSeat::on_floor;
  const WorkshopBuild a = plates(chute(), beside);
  const WorkshopBuild b = plates(chute(), on);
  CHECK(std::fabs(a.proof.volume / b.proof.volume - 1.0) < 1e-12);
  CHECK(a.workshop.parts.front().pattern->region != b.workshop.parts.front().pattern->region);
}

TEST_CASE("plates: a flat floor develops to S + t phi / 2 where it is rolled") {
  PlateOptions options;
  const WorkshopBuild build = plates(chute(), options);
  const ArcSpline& line = *build.master.spline;
  double developed = 0.0;
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name.starts_with("floor")) developed += bounds(part.pattern->region.outline).width();
  }
  const double turned = line.slope_angle(0.0) - line.slope_angle(line.length());
  CHECK(std::fabs(developed - (line.length() + 0.5 * kChannel.thickness * turned)) < 1e-9);
}

TEST_CASE("plates: frames at a joint share their bolts; holes of one of them are larger") {
  const WorkshopBuild build = plates(chute(), {});
  const ShopPart* frames[2] = {nullptr, nullptr};
  for (const ShopPart& part : build.workshop.parts) {
    if (part.name == "end_frame") frames[0] = &part;
    if (part.name == "end_frame_loose") frames[1] = &part;
  }
  REQUIRE(frames[0] != nullptr);
  REQUIRE(frames[1] != nullptr);
  const auto& tight = frames[0]->pattern->region.holes;
  const auto& loose = frames[1]->pattern->region.holes;
  REQUIRE(tight.size() == loose.size());
  for (std::size_t i = 0; i < tight.size(); ++i) {
    CHECK(tight[i].centre == loose[i].centre);
    CHECK(std::fabs(2.0 * tight[i].radius - 11e-3) < 1e-15);
    CHECK(std::fabs(2.0 * loose[i].radius - 12e-3) < 1e-15);
  }
  REQUIRE(build.joints.size() > 2);
  const std::size_t bolts = tight.size() * (build.joints.size() - 2);
  CHECK(build.workshop.items.front().quantity == bolts);
  CHECK(build.workshop.items.front().name == "bolt M10 x 30");
  CHECK(build.workshop.items.back().quantity == 2 * bolts);
  // Two frames meet in the plane of the joint: the downstream face of the one is the upstream face of the other.
  const Frame& before = frames[0]->places.front();
  const Frame& after = frames[1]->places[1];
  CHECK(norm(before.to_space({0.0, 0.0, frames[0]->thickness}) - after.origin) < 1e-12);
}

TEST_CASE("plates: no part exceeds its sheet, its transport length or its mass") {
  for (const double longest : {1.0, 1.7, 2.9}) {
    PlateOptions options;
    options.split.longest = longest;
    options.split.heaviest = 20.0;
    const WorkshopBuild build = plates(chute(), options);
    for (std::size_t i = 0; i + 1 < build.joints.size(); ++i) {
      CHECK(build.joints[i + 1] - build.joints[i] <= longest + 1e-9);
    }
    for (const ShopPart& part : build.workshop.parts) {
      const PlaneBox box = bounds(part.pattern->region.outline);
      CHECK(part.mass <= 20.0);
      CHECK(std::max(box.width(), box.height()) <= 3.0);
      CHECK(std::min(box.width(), box.height()) <= 1.5);
      CHECK(faults_of(part.pattern->region).empty());
      CHECK(part.pattern->region.outline.closed);
    }
  }
}

TEST_CASE("plates: as many bends as cost one hundredth of the exit speed, and one fewer would cost more") {
  PlateOptions options;
  options.floor = FloorMake::bent;
  options.split.sheet = {20.0, 2.0};
  const WorkshopBuild build = plates(chute(), options);
  const double cost = 1.0 - build.ride.exit_speed / build.ride.design_exit_speed;
  CHECK(build.ride.arrives);
  CHECK(cost <= 0.01);
  CHECK(cost > 0.008);
  PlateOptions fewer = options;
  fewer.bend.rule = FacetRule::bends;
  fewer.bend.value = static_cast<double>(build.ride.bends) / 2.0;
  const WorkshopBuild coarse = plates(chute(), fewer);
  CHECK(1.0 - coarse.ride.exit_speed / coarse.ride.design_exit_speed > 0.015);
  CHECK(build.workshop.bends.size() == build.ride.bends);
  // Each bend is one line of the pattern, up where the floor curls up; angles add up to what the track turns.
  const double sum = build.workshop.bends.back().sum.radians();
  const ArcSpline& line = *build.master.spline;
  CHECK(std::fabs(sum - (line.slope_angle(0.0) - line.slope_angle(line.length()))) < 1e-9);
  CHECK(build.workshop.parts.front().pattern->bends.size() == build.ride.bends);
}

TEST_CASE("plates: a kink costs 1 - (cos phi - mu sin phi) of the speed, against a ride by hand") {
  // Two flats of 1 m, 45 and 25 deg below the horizontal, from rest.
  parts::Facets facets;
  const double first = Angle::from_degrees(45.0).radians();
  const double second = Angle::from_degrees(25.0).radians();
  facets.corners = {{0.0, 0.0}, {math::cos(first), -math::sin(first)}};
  facets.corners.push_back(facets.corners.back() + Vec2{math::cos(second), -math::sin(second)});
  facets.kinks = {first - second};
  const double mu = kFriction.coefficient();
  const double g = 9.81;
  const double before = std::sqrt(2.0 * g * (math::sin(first) - mu * math::cos(first)));
  const double kink = first - second;
  const double after = before * (math::cos(kink) - mu * math::sin(kink));
  const double exit = std::sqrt(after * after + 2.0 * g * (math::sin(second) - mu * math::cos(second)));
  const parts::FacetRide ride = parts::ride_facets({facets}, {.friction = kFriction}, g, 0.0);
  REQUIRE(ride.arrives);
  CHECK(std::fabs(ride.speed / exit - 1.0) < 1e-12);
  const double time = 2.0 / before + 2.0 / (after + exit);
  CHECK(std::fabs(ride.time / time - 1.0) < 1e-12);
}

TEST_CASE("plates: where the floor falls away the body flies on and lands, against a flight by hand") {
  // 25 deg down for 1 m, then 45 deg.
  const double first = Angle::from_degrees(25.0).radians();
  const double second = Angle::from_degrees(45.0).radians();
  const double mu = kFriction.coefficient();
  const double g = 9.81;
  const auto floor_of = [&](double length) {
    parts::Facets facets;
    facets.corners = {{0.0, 0.0}, {math::cos(first), -math::sin(first)}};
    facets.corners.push_back(facets.corners.back() +
                             Vec2{length * math::cos(second), -length * math::sin(second)});
    facets.kinks = {first - second};
    return facets;
  };
  const double before = std::sqrt(2.0 * g * (math::sin(first) - mu * math::cos(first)));
  // It leaves the second flat's line with what of its speed is square to that, and gravity brings it back.
  const double kink = second - first;
  const double time = 2.0 * before * math::sin(kink) / (g * math::cos(second));
  const double way = before * math::cos(kink) * time + 0.5 * g * math::sin(second) * time * time;
  const double along = before * math::cos(kink) + g * math::sin(second) * time;
  const double after = along - mu * before * math::sin(kink);
  const double rest = 3.0 - way;
  const double exit =
      std::sqrt(after * after + 2.0 * g * (math::sin(second) - mu * math::cos(second)) * rest);
  const parts::FacetRide ride = parts::ride_facets({floor_of(3.0)}, {.friction = kFriction}, g, 0.0);
  REQUIRE(ride.arrives);
  CHECK(std::fabs(ride.speed / exit - 1.0) < 1e-12);
  CHECK(std::fabs(ride.time / (2.0 / before + time + 2.0 * rest / (after + exit)) - 1.0) < 1e-12);
  CHECK(ride.hops == 1);
  // Midway it is (v sin)^2/(2 g cos) above the second flat; the looks at it are a sixteenth of the flight apart.
  const double highest = std::pow(before * math::sin(kink), 2) / (2.0 * g * math::cos(second));
  CHECK(std::fabs(ride.highest_hop / highest - 1.0) < 1e-9);
  // Of a floor that ends before it comes down it is past the end in flight.
  const double ends = 0.5 * way;
  const parts::FacetRide past = parts::ride_facets({floor_of(ends)}, {.friction = kFriction}, g, 0.0);
  REQUIRE(past.arrives);
  const double there = std::sqrt(std::pow(before * math::cos(kink), 2) + 2.0 * g * math::sin(second) * ends);
  CHECK(std::fabs(past.speed / there - 1.0) < 1e-12);
  // Held, it follows the floor.
  const parts::FacetRide held =
      parts::ride_facets({floor_of(3.0)}, {.friction = kFriction, .held = true}, g, 0.0);
  CHECK(held.hops == 0);
  CHECK(held.speed < ride.speed);
}

TEST_CASE("plates: over a crest of ever more bends the body comes to the speed of the smooth one") {
  // 60 deg, a valley to 15 deg, a crest to 35 deg on which the load stays above nothing.
  const auto step = [](Vec2 from, double angle, double length) {
    return from + length * Vec2{math::cos(angle), math::sin(angle)};
  };
  const auto rad = [](double degrees) { return Angle::from_degrees(degrees).radians(); };
  std::vector<PathVertex> line{{{0.0, 0.0}, 0.0}};
  const auto straight = [&](double slope, double length) {
    line.push_back({step(line.back().at, rad(-slope), length), 0.0});
  };
  const auto arc = [&](double from, double to, double radius) {
    const double turn = rad(from - to);
    line.back().bulge = math::tan(0.25 * turn);
    const double chord = 2.0 * radius * math::sin(0.5 * std::fabs(turn));
    line.push_back({step(line.back().at, rad(-0.5 * (from + to)), chord), 0.0});
  };
  straight(60.0, 0.8);
  arc(60.0, 15.0, 3.0);
  straight(15.0, 1.0);
  arc(15.0, 35.0, 7.0);
  straight(35.0, 0.7);
  const auto track = std::make_shared<const ArcSpline>(ArcPath{line, false});
  const Body body{.friction = kFriction};
  const parts::FacetRide smooth = parts::ride_lines({track}, body, 9.81, 0.0);
  REQUIRE(smooth.arrives);
  REQUIRE(smooth.hops == 0);
  double before = 1.0;
  for (const double degrees : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    const parts::FacetRide ride = parts::ride_facets(
        {parts::facets_by_angle(*track, {0.0, track->length()}, rad(degrees), 0.0)}, body, 9.81, 0.0);
    CAPTURE(degrees, ride.speed, smooth.speed);
    REQUIRE(ride.arrives);
    CHECK(ride.hops > 0);
    const double lost = 1.0 - ride.speed / smooth.speed;
    CHECK(lost > 0.0);
    CHECK(lost < 0.6 * before);
    before = lost;
  }
  CHECK(before < 2e-3);
}

TEST_CASE(
    "plates: over a crest that is a hair too tight the body hops and goes on; over an edge it is told where "
    "it flies") {
  // 20 deg down for 2 m, a crest to 26 deg, 3 m straight; without friction u^2 = 2 g drop.
  const auto crest = [](double radius, double after) {
    const double first = Angle::from_degrees(-20.0).radians();
    const double turn = Angle::from_degrees(-6.0).radians();
    const Vec2 top{2.0 * math::cos(first), 2.0 * math::sin(first)};
    const double chord = 2.0 * radius * math::sin(0.5 * -turn);
    const Vec2 foot = top + chord * Vec2{math::cos(first + 0.5 * turn), math::sin(first + 0.5 * turn)};
    const Vec2 end = foot + after * Vec2{math::cos(first + turn), math::sin(first + turn)};
    return std::make_shared<const ArcSpline>(
        ArcPath{{{{0.0, 0.0}, 0.0}, {top, math::tan(0.25 * turn)}, {foot, 0.0}, {end, 0.0}}, false});
  };
  const double g = 9.81;
  const double speed = std::sqrt(2.0 * g * 2.0 * math::sin(Angle::from_degrees(20.0).radians()));
  const double free = speed * speed / (g * math::cos(Angle::from_degrees(20.0).radians()));
  const Body body{.friction = Friction::from_coefficient(0.0)};
  const parts::FacetRide held = parts::ride_lines({crest(1.5 * free, 3.0)}, body, g, 0.0);
  CHECK(held.arrives);
  CHECK(held.hops == 0);
  const parts::FacetRide hop = parts::ride_lines({crest(0.97 * free, 3.0)}, body, g, 0.0);
  REQUIRE(hop.arrives);
  CHECK(hop.hops == 1);
  CHECK(hop.highest_hop > 1e-6);
  CHECK(hop.highest_hop < 5e-3);
  // What it carries into the floor where it lands is lost, and no more.
  const double drop = crest(0.97 * free, 3.0)->at(crest(0.97 * free, 3.0)->length()).drop;
  CHECK(hop.speed < std::sqrt(2.0 * g * drop));
  CHECK(hop.speed > 0.999 * std::sqrt(2.0 * g * drop));
  const parts::FacetRide off = parts::ride_lines({crest(0.5 * free, 0.05)}, body, g, 0.0);
  CHECK_FALSE(off.arrives);
  CHECK(off.stopped.find("it leaves the floor 2 m along it at 3.66") == 0);
  const parts::FacetRide stalls =
      parts::ride_lines({crest(free, 3.0)}, {.friction = kFriction, .entry_speed = 0.0}, g, 0.0);
  CHECK(stalls.arrives);
  const parts::FacetRide stuck = parts::ride_lines(
      {crest(free, 3.0)}, {.friction = Friction::from_angle(Angle::from_degrees(40.0)), .entry_speed = 1.0},
      g, 0.0);
  CHECK(stuck.stopped.find("it stalls ") == 0);
}

TEST_CASE("offset line: where it folds at the start it begins in the plane of the start") {
  // An eighth of a circle of radius 0.1 m from a vertical start, then 2 m straight: a wall of 0.25 m folds over the arc.
  const double r = 0.1;
  const double q = std::sqrt(0.5);
  const Vec2 end{r * (1.0 - q), -r * q};
  const ArcSpline track(
      {{{{0.0, 0.0}, math::tan(std::numbers::pi / 16.0)}, {end, 0.0}, {end + 2.0 * Vec2{q, -q}, 0.0}},
       false});
  const parts::Span whole{0.0, track.length()};
  CHECK(parts::folds(track, whole, 0.25));
  const auto line = parts::offset_line(track, whole, 0.25);
  REQUIRE(line);
  CHECK(norm(line->vertices.front().at - Vec2{r + 0.15 / q, 0.0}) < 1e-14);
  CHECK(std::fabs(length(*line) - 1.85) < 1e-14);
  CHECK_FALSE(parts::folds(track, whole, 0.05));
  const auto low = parts::offset_line(track, whole, 0.05);
  REQUIRE(low);
  CHECK(norm(low->vertices.front().at - Vec2{0.05, 0.0}) < 1e-15);
  CHECK(std::fabs(length(*low) - (0.05 * std::numbers::pi / 4.0 + 2.0)) < 1e-14);
}

TEST_CASE("plates: random tracks and measures make plates that add up, with no clash, by either floor") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 16; ++run) {
    const ClothoidSpline track = testing::random_track(random, {.smallest = 1.0, .bends = 5, .fading = true});
    const double t = random.between(2e-3, 8e-3);
    const ChannelMeasures channel{random.between(0.2, 0.8), random.between(0.1, 0.3), t};
    PlateOptions options;
    options.floor = random.integer(0, 1) == 0 ? FloorMake::bent : FloorMake::rolled;
    options.bend.rule = FacetRule::segment_angle;
    options.bend.value = random.between(0.02, 0.2);
    options.split.longest = random.between(0.8, 3.0);
    options.flanges.pitch = random.between(0.08, 0.2);
    const WorkshopBuild build = plates(track, options, channel);  // throws where parts clash or do not add up
    CHECK(build.proof.pairs > 0);
    CHECK(build.proof.smallest_gap > 0.0);
    for (const ShopPart& part : build.workshop.parts) {
      CHECK(part.mass > 0.0);
      CHECK(faults_of(part.pattern->region).empty());
    }
    double pieces = 0.0;
    for (const ShopPart& part : build.workshop.parts) {
      if (part.name.starts_with("floor")) {
        pieces += bounds(part.pattern->region.outline).width() * static_cast<double>(part.quantity());
      }
    }
    CHECK(std::fabs(pieces / track.length() - 1.0) < 0.02);
  }
}

TEST_CASE("plates: what cannot be made is refused with place, value and bound") {
  PlateOptions whole;
  whole.split.allowed = false;
  CHECK(refusal(whole).find("split|the floor of unit 1 takes 7.7") != std::string::npos);
  PlateOptions pitch;
  pitch.flanges.pitch = 20e-3;
  CHECK(
      refusal(pitch).find(
          "flanges.pitch|pitch: 20 mm is too close for M10|Middles of holes of 12 mm are at least 28.8 mm") !=
      std::string::npos);
  PlateOptions edge;
  edge.flanges.width = 20e-3;
  CHECK(refusal(edge).find("flanges.width|width: 20 mm puts holes for M10 10 mm from the edge") !=
        std::string::npos);
  // At the bound: 1.2 holes of 12 mm on either side.
  edge.flanges.width = 28.7e-3;
  CHECK(refusal(edge).find("flanges.width|width: 28.7 mm puts holes for M10 14.35 mm from the edge") !=
        std::string::npos);
  edge.flanges.width = 28.8e-3;
  CHECK(refusal(edge).find("flanges.width") == std::string::npos);
  // Rules that are left out do not make holes wider than their bar.
  PlateOptions unruled;
  unruled.shop.hole_edge_diameters = 0.0;
  unruled.shop.hole_pitch_diameters = 0.0;
  unruled.flanges.width = 14e-3;
  unruled.flanges.pitch = 13e-3;
  CHECK(refusal(unruled).find(
            "flanges.width|width: 14 mm puts holes for M10 7 mm from the edge|Their centres are at "
            "least 8.4 mm from it (less leaves no web).|a width of at least 16.8 mm, or a smaller "
            "bolt") != std::string::npos);
  unruled.flanges.width = 17e-3;
  CHECK(refusal(unruled) ==
        "flanges.pitch|pitch: 13 mm is too close for M10|Middles of holes of 12 mm are at least 14.4 mm "
        "apart (less "
        "leaves no web).|pitch: 15 mm, or a smaller bolt\n");
  unruled.flanges.pitch = 15e-3;
  CHECK(refusal(unruled).empty());
  PlateOptions wide;
  wide.flanges.width = 0.3;
  CHECK(refusal(wide).find("width: 300 mm is more than the walls are high, 250 mm") != std::string::npos);
  PlateOptions punch;
  punch.floor = FloorMake::bent;
  punch.bend.inner_radius = 1e-3;
  CHECK(refusal(punch).find("bend.inner_radius|inner_radius: 1 mm is less than the plate's thickness") !=
        std::string::npos);
  PlateOptions bolt;
  bolt.flanges.bolt = 11;
  CHECK(refusal(bolt).find("flanges.bolt|bolt: M11 is no size whose holes are known") != std::string::npos);
  PlateOptions seat;
  seat.floor = FloorMake::bent;
  seat.walls = WallSeat::on_floor;
  CHECK(refusal(seat, {0.4, 0.06, 4e-3, 20e-3}).find("walls|walls: on-floor does not go with a bent floor") !=
        std::string::npos);
}

TEST_CASE("plates: units get as short as the heaviest part asks, be it floor or curb") {
  PlateOptions options;
  options.split.heaviest = 12.0;
  const WorkshopBuild build = plates(chute(), options, {0.445, 0.14, 3e-3, 40e-3});
  double heaviest = 0.0;
  for (const ShopPart* const wall : named(build, "wall")) heaviest = std::max(heaviest, wall->mass);
  CHECK(heaviest <= 12.0);
  CHECK(heaviest > 9.0);
}

TEST_CASE("k factor: DIN 6935 at 1, 3 and 10 thicknesses") {
  CHECK(std::fabs(k_factor(4e-3, 4e-3) - 0.325) < 1e-12);
  CHECK(std::fabs(k_factor(12e-3, 4e-3) - 0.4443) < 1e-4);
  CHECK(k_factor(40e-3, 4e-3) == 0.5);
}

TEST_CASE("clearance holes are those of ISO 273") {
  CHECK(clearance_hole(12, HoleFit::fine) == 13e-3);
  CHECK(clearance_hole(12, HoleFit::medium) == 13.5e-3);
  CHECK(clearance_hole(16, HoleFit::coarse) == 18.5e-3);
  CHECK_THROWS_AS(clearance_hole(11, HoleFit::medium), InputError);
}

TEST_CASE(
    "plates: a frame so thick that the channel bends out of its gap is refused with the gap that would do") {
  const ClothoidSpline crest(Angle::from_degrees(20.0), {{3.0, -0.25, -0.25}});
  PlateOptions options;
  options.flanges.thickness = 0.1;
  const std::string text = refusal_of([&] { return plates(crest, options); });
  CHECK(
      text.find("flanges.gap|gap: 0.5 mm is closed where the track bends, at 0 mm along it|Within a frame of "
                "100 mm the section departs by 1.25") == 0);
  CHECK(text.find("|gap: 1.4 mm, or a thinner frame") != std::string::npos);
  options.flanges.gap = 1.4e-3;
  CHECK(plates(crest, options).proof.smallest_gap > 0.0);
  const ClothoidSpline hollow(Angle::from_degrees(60.0), {{3.0, 0.25, 0.25}});
  options.flanges.gap = 0.5e-3;
  CHECK(plates(hollow, options).proof.pairs > 0);
  options.round = RoundMake::staves;
  const section::Pipe pipe{0.4, 3e-3};
  CHECK(refusal_of([&] { return plates_of(hollow, pipe, options); }).find("flanges.gap|") == 0);
  // Round an outline they go below the run surface alone.
  const section::Polygon beam{{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.0}, {0.0, 0.0}, {-0.2, 0.0}}};
  for (const ShopPart* frame : named(plates_of(hollow, beam, options), "frame"))
    CHECK(bounds(frame->pattern->region.outline).high.y == Approx(0.0).margin(1e-12));
}

TEST_CASE("plates: walls that fold over are refused with a height that does not") {
  const ClothoidSpline hollow(Angle::from_degrees(80.0), {{0.2, 0.0, 0.0}, {0.6, 2.5, 2.5}});
  ChannelMeasures channel{0.4, 2.0, 4e-3};
  const std::string text = refusal_of([&] { return plates(hollow, {}, channel); });
  const std::size_t at = text.find("|wall_height: ");
  REQUIRE(at != std::string::npos);
  const std::string tail = text.substr(at + 14);
  channel.wall_height = std::stod(tail) * (tail.find(" mm") != std::string::npos ? 1e-3 : 1.0);
  CHECK(channel.wall_height < 2.0);
  CHECK(plates(hollow, {}, channel).proof.pairs > 0);
}

TEST_CASE("plates: a bar that goes through a plate between all of its corners is a clash") {
  const auto part = [](const char* name, const Prism& body, const Frame& place) {
    ShopPart made;
    made.name = name;
    made.thickness = 4e-3;
    made.body = body;
    made.places = {place};
    return made;
  };
  const Frame across{{0.3, 0.2, -0.37}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  const Frame lying{{-0.37, 0.2, 0.02}, {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, {-1.0, 0.0, 0.0}};
  Workshop workshop;
  workshop.parts = {part("plate", {{rectangle({}, {0.6, 0.4}), {}, {}}, 4e-3}, {})};
  // A square bar of 1 m, upright through the middle; the same drawn as a strip cut along.
  for (const Prism& bar : {Prism{{rectangle({}, {0.02, 0.02}), {}, {}}, 1.0},
                           Prism{{rectangle({}, {0.02, 0.02}), {}, {}}, 0.93}}) {
    workshop.parts.resize(1);
    workshop.parts.push_back(part("bar", bar, across));
    try {
      (void)parts::require_no_clash(workshop);
      FAIL("no clash found");
    } catch (const InternalError& error) {
      CHECK(std::string(error.what()).find("parts clash: bar reaches ") != std::string::npos);
    }
    workshop.parts[1].places = {lying};
    CHECK(parts::require_no_clash(workshop) == 1);
  }
}

TEST_CASE("bent floors: bends that cost more speed than is asked for are told, with why and what would do") {
  const auto note_of = [](const WorkshopBuild& build) { return shortfall_of(build.workshop, "speed_loss"); };
  const auto cost_of = [](const WorkshopBuild& build) {
    return 1.0 - build.ride.exit_speed / build.ride.design_exit_speed;
  };
  PlateOptions options;
  options.floor = FloorMake::bent;
  // On a crest bends lose no more than in a hollow: as many as are asked for are enough.
  const ClothoidSpline crest(Angle::from_degrees(35.0), {{2.0, 0.0, 0.0}, {2.0, -0.15, -0.15}});
  for (const section::Measures& measures :
       {section::Measures(section::UChannel{WidthLaw(0.4), 0.25, 4e-3}),
        section::Measures(section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(20.0), 4e-3})}) {
    options.bend.value = 0.01;
    const WorkshopBuild kept = plates_of(crest, measures, options);
    REQUIRE(kept.ride.arrives);
    CHECK(cost_of(kept) < 1.05 * options.bend.value);
    CHECK(note_of(kept).empty());
  }
  // In a hollow flats that are no shorter than the press makes them hold it up.
  const ClothoidSpline hollow(Angle::from_degrees(60.0), {{1.0, 0.0, 0.0}, {0.3, 3.0, 3.0}, {0.5, 0.0, 0.0}});
  options.bend.value = 0.001;
  options.split.sheet = {20.0, 8.0};
  options.flanges.wanted = false;
  const section::UChannel channel{WidthLaw(0.4), 0.1, 4e-3};
  const WorkshopBuild missed = plates_of(hollow, channel, options);
  const std::string note = note_of(missed);
  INFO(note);
  CHECK(note.find("bend.speed_loss|speed_loss: 0.1 % is not reached: " + std::to_string(missed.ride.bends) +
                  " bends cost ") == 0);
  CHECK(note.find(" of the exit speed|Flats are as short as the shop makes them, 16 mm.|speed_loss: ") !=
        std::string::npos);
  CHECK(note.ends_with(", or floor: rolled"));
  // What it says would do does.
  const std::string key = "|speed_loss: ";
  REQUIRE(note.rfind(key) != std::string::npos);
  options.bend.value = 0.01 * std::stod(note.substr(note.rfind(key) + key.size()));
  CHECK(note_of(plates_of(hollow, channel, options)).empty());
}

TEST_CASE("channels: a frame wider than the walls are high is refused with one that finds place") {
  PlateOptions told;
  told.flanges.as_told = true;
  const auto refused = [&](double height) { return refusal(told, {0.06, height, 1e-3}); };
  CHECK(
      refused(0.020).find("flanges.width|width: 50 mm is more than the walls are high, 20 mm|The frame would "
                          "stand out farther than the channel is deep.|width: 20 mm with bolt: M6, or "
                          "flanges: none") == 0);
  told.flanges.width = 20e-3;
  told.flanges.bolt = 6;
  CHECK(refused(0.020).empty());
  told.flanges.width = 50e-3;
  CHECK(refused(0.020).find("|width: 20 mm, or flanges: none") != std::string::npos);
  CHECK(refused(0.005).find("|higher walls, or flanges: none") != std::string::npos);
}
