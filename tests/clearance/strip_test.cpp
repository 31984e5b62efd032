// The envelope of a section over a track, against the meshes of built solids and against cases by hand.

#include "clearance/strip.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/cycloid.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/solid/sweep.hpp"

#include "clearance/random_section.hpp"
#include "clearance/stations.hpp"
#include "support/catch.hpp"
#include "support/mesh_clearance.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <vector>

using namespace glissade;
using clearance::Approach;
using clearance::Pass;
using clearance::Region;
using clearance::Strip;

namespace {

constexpr int kSolids = 150;
constexpr int kObstacles = 12;

Approach closest(const Centerline& track, const Envelope& envelope, const Region& region, int samples = 20,
                 double accuracy = 1e-9) {
  const Strip strip(track, envelope, testing::stations_of(track, samples));
  return strip.least(region, strip.along(region), accuracy).closest;
}

CenterlinePtr random_track(testing::Random& random, std::ostream& words) {
  const double run = random.between(2.0, 12.0);
  const double friction = random.between(0.0, 0.5);
  const double drop = run * (friction + random.between(0.05, 1.5));
  words << "run " << run << ", drop " << drop << ", mu " << friction;
  switch (random.integer(0, 4)) {
    case 0:
      words << ", straight";
      return std::make_shared<StraightLine>(Endpoints{run, drop});
    case 1:
      words << ", cycloid";
      return std::make_shared<Cycloid>(Endpoints{run, drop});
    case 2: {
      words << ", clothoids:";
      std::vector<ClothoidSegment> segments;
      double curvature = random.between(-0.5, 0.5);
      for (int i = random.integer(1, 4); i > 0; --i) {
        const double next = random.between(-1.2, 1.2);
        segments.push_back({random.between(0.4, 3.0), curvature, next});
        words << " " << segments.back().length << " " << curvature << " " << next << ",";
        curvature = random.integer(0, 1) == 0 ? next : 0.0;
      }
      const Angle entry = Angle::from_degrees(random.between(-20.0, 85.0));
      words << " from " << entry.radians();
      return std::make_shared<ClothoidSpline>(entry, segments);
    }
    default:
      words << ", fastest";
      return std::make_shared<CoulombBrachistochrone>(Endpoints{run, drop},
                                                      Friction::from_coefficient(friction));
  }
}

/// A star-shaped outline near the track: beside it, before its start, past its finish, above and below.
std::vector<Vec2> random_outline(testing::Random& random, const Centerline& track) {
  const CenterlinePoint near = track.at(random.between(0.0, 1.0) * track.length());
  const double size = random.between(0.02, 0.6);
  const double away = random.between(0.0, 2.5);
  const double direction = random.between(0.0, 6.283);
  const Vec2 middle{near.x + away * std::cos(direction), near.drop + away * std::sin(direction)};
  std::vector<Vec2> outline;
  const int corners = random.integer(3, 9);
  for (int k = 0; k < corners; ++k) {
    const double angle = 6.283185307179586 * k / corners + 0.1;
    const double radius = size * random.between(0.2, 1.0);
    outline.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
  }
  return outline;
}

/// @return whether a place of the mesh lies over the area's runs and below its lower side, by more than `slack`
bool mesh_below(const testing::SideView& facets, const std::vector<Vec2>& outline, double slack) {
  constexpr int kPlaces = 16;
  const auto is_below = [&](Vec2 point) {
    double highest = INFINITY;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i];
      const Vec2 b = outline[(i + 1) % outline.size()];
      if (std::min(a.x, b.x) > point.x || std::max(a.x, b.x) < point.x || a.x == b.x) continue;
      highest = std::min(highest, a.y + (b.y - a.y) * (point.x - a.x) / (b.x - a.x));
    }
    return point.y > highest + slack;
  };
  for (const auto& facet : facets) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (int place = 0; place < kPlaces; ++place) {
        const Vec2 along = facet[(k + 1) % 3] - facet[k];
        if (is_below(facet[k] + static_cast<double>(place) / kPlaces * along)) return true;
      }
    }
  }
  return false;
}

}  // namespace

TEST_CASE(
    "strip: distances from random obstacles are those of the built solid's mesh, within its tolerance") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int solids = testing::thorough() ? kSolids : kSolids / 2;
  int trimmed = 0;
  int apart = 0;
  int met = 0;
  int wrong_side = 0;
  for (int i = 0; i < solids; ++i) {
    std::ostringstream words;
    words.precision(17);
    const CenterlinePtr track = random_track(random, words);
    const CrossSection section = random_section(random, words);
    INFO("solid " << i << ": " << words.str());
    SweepOptions options;
    options.tolerance = 2e-3;
    options.shape_triangles = 500;
    const Placement placement({random.between(-5.0, 5.0), 3.0, 1.0},
                              Angle::from_degrees(random.between(-180.0, 180.0)));
    Solid solid;
    try {
      solid = sweep(*track, section, placement, options);
    } catch (const InputError&) {
      continue;
    }
    trimmed += solid.trimmed ? 1 : 0;
    const testing::SideView facets = testing::side_view(solid.mesh, placement);
    const Envelope envelope{-section.lowest(), section.highest(), 0.0};
    const double slack = solid.max_deviation + 1e-9;
    for (int k = 0; k < kObstacles; ++k) {
      const std::vector<Vec2> outline = random_outline(random, *track);
      INFO("obstacle " << k << " at " << outline[0].x << " " << outline[0].y);
      const double expected = testing::mesh_distance(facets, outline, true);
      const Approach either =
          closest(*track, envelope, Region::area(outline, Pass::either), random.integer(3, 30));
      CAPTURE(expected, either.value, either.arc_length, either.place.height);
      CHECK(std::max(either.value, 0.0) == Approx(expected).margin(slack));
      if (either.value > slack) ++apart;
      if (either.value < -slack) ++met;
      const Approach above = closest(*track, envelope, Region::area(outline, Pass::above));
      CHECK(std::min(above.value, 0.0) <= std::max(either.value, 0.0) + 1e-9);
      if (above.value > 0.0) CHECK(above.value == Approx(either.value).margin(1e-8));
      if (above.value >= 0.0) CHECK_FALSE(mesh_below(facets, outline, slack));
      if (either.value > 0.0 && above.value < -slack) {
        ++wrong_side;
        CHECK(mesh_below(facets, outline, 0.0));
      }
    }
  }
  CAPTURE(trimmed, apart, met, wrong_side);
  CHECK(trimmed > solids / 5);
  CHECK(apart > solids);
  CHECK(met > solids / 2);
  CHECK(wrong_side > solids / 10);
}

TEST_CASE("strip: what slides leans through the end planes, the solid does not") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr int kTracks = 60;
  constexpr int kPlaces = 4000;
  int beyond = 0;
  for (int i = 0; i < kTracks; ++i) {
    std::ostringstream words;
    words.precision(17);
    const CenterlinePtr track = random_track(random, words);
    INFO("track " << i << ": " << words.str());
    const Envelope walls{random.between(0.0, 0.2), random.between(0.0, 0.8), 0.0};
    Envelope whole = walls;
    whole.headroom = random.between(0.1, 2.5);
    for (int k = 0; k < kObstacles; ++k) {
      const Region area = Region::area(random_outline(random, *track), Pass::either);
      const double solid = closest(*track, walls, area).value;
      double sliding = INFINITY;
      for (int place = 0; place <= kPlaces; ++place) {
        const CenterlinePoint at = track->at(std::min(track->length(), track->length() * place / kPlaces));
        const Vec2 foot{at.x, at.drop};
        const Vec2 ends[] = {
            foot, foot + whole.headroom * Vec2{std::sin(at.slope_angle), -std::cos(at.slope_angle)}};
        sliding = std::min(sliding, area.nearest(ends).value);
      }
      const double expected = std::min(solid, sliding);
      const Approach found = closest(*track, whole, area);
      CAPTURE(k, solid, sliding, found.value, found.arc_length, found.place.height);
      // Between two places what slides is hardly nearer; depths are another matter.
      const double between = (1.0 + whole.headroom) * 8.0 / kPlaces;
      if (expected > 0.0) {
        CHECK(found.value <= expected + 1e-8);
        CHECK(found.value >= expected - between);
        if (sliding < solid - 1e-3) ++beyond;
        if (found.place.height > walls.above + 1e-6) CHECK(found.place.part == EnvelopePart::headroom);
      } else {
        CHECK(found.value < between);
      }
    }
  }
  CHECK(beyond > kTracks / 2);
}

TEST_CASE(
    "strip: below walls that fold over a tight start, what slides comes closest past its centres of "
    "curvature") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr int kPlaces = 4000;
  int between = 0;
  for (int i = 0; i < 30; ++i) {
    const Endpoints ends{random.between(1.0, 4.0), random.between(1.0, 3.0)};
    const CoulombBrachistochrone track(ends, Friction::from_coefficient(random.between(0.0, 0.2)));
    Envelope whole{random.between(0.0, 0.1), random.between(0.3, 0.8), 0.0};
    whole.headroom = random.between(0.05, 0.25);
    const double x = random.between(0.0, 1.5) * whole.headroom;
    const double above = -random.between(0.2, 1.5);
    const Region area = Region::area({{x, above}, {x + 0.02, above}, {x + 0.01, above - 0.05}}, Pass::either);
    double sliding = INFINITY;
    double where = 0.0;
    for (int place = 0; place <= kPlaces; ++place) {
      const double share = static_cast<double>(place) / kPlaces;  // closer where curvature has no bound
      const CenterlinePoint at = track.at(share * share * track.length());
      const Vec2 foot{at.x, at.drop};
      const Vec2 normal{std::sin(at.slope_angle), -std::cos(at.slope_angle)};
      const Vec2 normals[] = {foot, foot + whole.headroom * normal};
      const double value = area.nearest(normals).value;
      if (value < sliding) where = at.arc_length;
      sliding = std::min(sliding, value);
    }
    const Approach found = closest(track, whole, area);
    CAPTURE(i, whole.headroom, sliding, where, found.value, found.arc_length);
    CHECK(found.value <= sliding + 1e-8);
    if (where > 0.0 && where < 0.1) ++between;
  }
  CHECK(between > 5);
}

TEST_CASE("strip: a beam is met by the walls of a straight channel, not by its floor") {
  // 45 degrees down; the beam's corner lies 0.5 m above the floor, square to it.
  const StraightLine track(Endpoints{10.0, 10.0});
  const double half = std::sqrt(0.5);
  const Vec2 corner{5.0 + 0.5 * half, 5.0 - 0.5 * half};
  const Region beam = Region::area(
      {corner, {corner.x, corner.y - 0.3}, {corner.x + 0.3, corner.y - 0.3}, {corner.x + 0.3, corner.y}},
      Pass::either);
  const Approach floor = closest(track, {}, beam);
  CHECK(floor.value == Approx(0.5));
  const Approach walls = closest(track, {0.02, 0.2, 0.0}, beam);
  CHECK(walls.value == Approx(0.3));
  CHECK(walls.place.part == EnvelopePart::rim);
  CHECK(walls.place.height == Approx(0.2));
  CHECK(closest(track, {0.02, 0.2, 0.25}, beam).place.part == EnvelopePart::headroom);
  CHECK(closest(track, {0.02, 0.6, 0.0}, beam).value < 0.0);
}

TEST_CASE("strip: the underside and the end faces keep their distance too") {
  const StraightLine track(Endpoints{8.0, 6.0});
  const Envelope envelope{0.1, 0.5, 0.0};
  const Region ground = Region::line({{-5.0, -2.75}, {15.0, 12.25}}, true);  // parallel, 1 m below
  const Approach under = closest(track, envelope, ground);
  CHECK(under.value == Approx(0.7));
  CHECK(under.place.part == EnvelopePart::underside);
  // A post 0.2 m beyond the start's plane, 0.3 m above the floor, and one past the finish.
  const Vec2 tangent{0.8, 0.6};
  const Vec2 normal{0.6, -0.8};
  const auto post = [&](Vec2 at, double along) {
    const Vec2 near = at + along * tangent + 0.3 * normal;
    const Vec2 far = near + (along > 0.0 ? 0.1 : -0.1) * tangent;
    return Region::area({near, far, far + 0.01 * normal}, Pass::either);
  };
  const Approach before = closest(track, envelope, post({0.0, 0.0}, -0.2));
  CHECK(before.value == Approx(0.2));
  CHECK(before.place.part == EnvelopePart::start_face);
  const Approach past = closest(track, envelope, post({8.0, 6.0}, 0.2));
  CHECK(past.value == Approx(0.2));
  CHECK(past.place.part == EnvelopePart::finish_face);
}

TEST_CASE("strip: above a vertical start nothing of the walls is left") {
  // A cycloid of radius a starts straight down: its start face is level, and the walls end there.
  const Cycloid track(Endpoints{10.0, 4.0});
  const Envelope envelope{0.0, 0.6, 0.0};
  const Region ceiling = Region::line({{-1.0, -0.1}, {12.0, -0.1}}, false);
  const Approach start = closest(track, envelope, ceiling);
  CHECK(start.value == Approx(0.1).epsilon(1e-9));
  // The face reaches as far as the level at the top of the walls leaves its plane, 2 a asin(h/2a) along; the
  // radius of curvature of a cycloid after the arc length s is sqrt(s (8 a - s)).
  const double s = 1.0;
  const double radius = 1.0 / track.at(s).curvature;
  const double a = (radius * radius + s * s) / (8.0 * s);
  const double face = 2.0 * a * std::asin(0.6 / (2.0 * a));
  const Vec2 tip{face + 0.05, -0.5};
  const Region post = Region::area({tip, tip + Vec2{0.3, -1.0}, tip + Vec2{0.3, 0.0}}, Pass::either);
  CHECK(closest(track, envelope, post).value == Approx(std::hypot(0.05, 0.5)).epsilon(1e-9));
}

TEST_CASE("strip: walls higher than the radius of a valley fold over and come no further than the centre") {
  // A valley of radius 0.5 m, a straight on either side, and walls of 1.2 m.
  const ClothoidSpline track(Angle::from_degrees(60.0), {{2.0, 0.0, 0.0}, {1.0, 2.0, 2.0}, {3.0, 0.0, 0.0}});
  const CrossSection section = CrossSection::u_channel(0.4, 1.2, 0.02);
  SweepOptions options;
  options.tolerance = 1e-3;
  const Solid solid = sweep(track, section, Placement(), options);
  REQUIRE(solid.trimmed);
  const testing::SideView facets = testing::side_view(solid.mesh, Placement());
  const Envelope envelope{0.02, 1.2, 0.0};
  for (double run = 0.5; run < 4.0; run += 0.25) {
    const std::vector<Vec2> beam = {{run, -2.0}, {run + 0.1, -2.0}, {run + 0.1, -0.3}, {run, -0.3}};
    const double expected = testing::mesh_distance(facets, beam, true);
    INFO("beam at " << run << ", " << expected);
    CHECK(std::max(0.0, closest(track, envelope, Region::area(beam, Pass::either)).value) ==
          Approx(expected).margin(1.1e-3));
  }
}

TEST_CASE("strip: coarse stations find the same place as fine ones") {
  const CoulombBrachistochrone track(Endpoints{10.0, 5.0}, Friction::from_coefficient(0.2));
  const Envelope envelope{0.05, 0.6, 0.0};
  // A spike that reaches between two coarse stations.
  const CenterlinePoint at = track.at(0.613 * track.length());
  const Vec2 normal{std::sin(at.slope_angle), -std::cos(at.slope_angle)};
  const Vec2 tip = Vec2{at.x, at.drop} + 0.599 * normal;
  const Region spike = Region::area({tip, tip + Vec2{-1e-4, -1.0}, tip + Vec2{1e-4, -1.0}}, Pass::either);
  for (const int samples : {2, 5, 20, 400}) {
    INFO(samples << " stations");
    CHECK(closest(track, envelope, spike, samples).value < 0.0);
  }
  const Vec2 off = Vec2{at.x, at.drop} + 0.7 * normal;
  const Region further = Region::area({off, off + Vec2{-1e-4, -1.0}, off + Vec2{1e-4, -1.0}}, Pass::either);
  for (const int samples : {2, 5, 20, 400}) {
    INFO(samples << " stations");
    CHECK(closest(track, envelope, further, samples).value == Approx(0.1).margin(1e-9));
  }
}

TEST_CASE("strip: how deep a wall that is folded over reaches into a half-plane is told to a millionth") {
  // A valley tighter than the wall is high, then a straight: the corner of the start face is on the top of the straight's wall.
  const double slope = 40.0 * std::numbers::pi / 180.0;
  const double end = -10.0 * std::numbers::pi / 180.0;
  const double radius = 0.4;
  const ClothoidSpline track(Angle::from_radians(slope),
                             {{radius * (slope - end), 1.0 / radius, 1.0 / radius}, {2.0, 0.0, 0.0}});
  const CenterlinePoint joint = track.at(radius * (slope - end));
  const auto up = [](double angle) { return Vec2{std::sin(angle), -std::cos(angle)}; };
  for (const double height : {0.41, 0.45, 0.5, 0.6}) {
    const double along = (height + dot(Vec2{joint.x, joint.drop}, up(end))) / dot(up(slope), up(end));
    const Vec2 corner = along * up(slope);
    const Vec2 forbidden = up(end) - Vec2{std::cos(slope), std::sin(slope)};
    for (const double deep : {0.003, 0.07, 5.0}) {
      const Region region = Region::half_plane(corner - (deep / norm(forbidden)) * forbidden, forbidden);
      const Approach least = closest(track, {0.04, height, 0.0}, region);
      CAPTURE(height, deep, least.value);
      CHECK(least.value <= -(1.0 - 2e-6) * deep);
      CHECK(least.value >= -deep - 1e-9);
    }
  }
}
