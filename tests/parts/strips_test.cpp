// Sections that lean or are round, as strips and as mitred tubes: developed exactly, adding up to the section.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/section/cross_section.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/bodies/brep.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace strips_test {

namespace {

using namespace glissade;
using namespace testing;

section::Trapezoid trapezoid(double lean_deg) {
  return {WidthLaw(0.4), 0.25, Angle::from_degrees(lean_deg), 4e-3};
}

/// Length of the line at a height above the track.
double space_length(const ArcSpline& line, double height) {
  double sum = 0.0;
  for (const TrackArc& arc : line.arcs()) sum += arc.length * (1.0 - arc.curvature * height);
  return sum;
}

}  // namespace

TEST_CASE("strips: those of a trapezoid add up to the section that is swept, A S - M phi") {
  const WorkshopBuild build = plates_of(chute(), trapezoid(25.0));
  const CrossSection section{section::Measures(trapezoid(25.0))};
  const ArcSpline& line = *build.master.spline;
  const double turned = line.slope_angle(0.0) - line.slope_angle(line.length());
  const double exact = section.area() * line.length() - section.first_moment() * turned;
  CHECK(std::fabs(build.proof.volume / exact - 1.0) < kPartsVolumeAccuracy);
  CHECK(build.proof.edge_mismatch < 1e-9);
  CHECK(build.proof.pairs > 10);
}

TEST_CASE(
    "strips: a wall that leans develops along a curve of curvature kappa cos b, its edges as long as in "
    "space") {
  PlateOptions options;
  options.split.sheet = {20.0, 8.0};
  const WorkshopBuild build = plates_of(chute(), trapezoid(35.0), options);
  const ArcSpline& line = *build.master.spline;
  const ShopPart& wall = part_of(build, "left_wall");
  const std::vector<PathPiece> pieces = pieces_of(wall.pattern->region.outline);
  const std::size_t arcs = line.arcs().size();
  REQUIRE(pieces.size() == 2 * arcs + 2);
  // Middle of the thickness at the mitre and at the level rim.
  const double t = 4e-3;
  const double low = -0.5 * t;
  const double high = 0.25;
  double base = 0.0;
  double rim = 0.0;
  for (std::size_t i = 0; i < arcs; ++i) {
    base += length(pieces[i]);
    rim += length(pieces[arcs + 1 + i]);
    const double sweep = 4.0 * math::atan(pieces[i].bulge);
    CHECK(std::fabs(sweep - line.arcs()[i].curvature * line.arcs()[i].length *
                                math::cos(Angle::from_degrees(35.0).radians())) < 1e-12);
  }
  CHECK(std::fabs(base - space_length(line, low)) < 1e-9);
  CHECK(std::fabs(rim - space_length(line, high)) < 1e-9);
}

TEST_CASE("strips: upright walls come out as the plates of a channel do") {
  PlateOptions options;
  options.flanges.wanted = false;
  const WorkshopBuild leaning = plates_of(chute(), trapezoid(1e-7), options);
  const WorkshopBuild upright = plates_of(chute(), section::UChannel{WidthLaw(0.4), 0.25, 4e-3}, options);
  CHECK(std::fabs(leaning.proof.volume / upright.proof.volume - 1.0) < 1e-6);
  CHECK(leaning.joints == upright.joints);
}

TEST_CASE(
    "strips: staves touch a round section at its floor and depart from it by no more than their tolerance") {
  for (const double tolerance : {0.5e-3, 2e-3, 8e-3}) {
    PlateOptions options;
    options.stave_tolerance = tolerance;
    options.round = RoundMake::staves;
    const WorkshopBuild build = plates_of(chute(), section::HalfPipe{0.4, 0.05, 4e-3}, options);
    const ShopPart& floor = part_of(build, "floor");
    const auto& body = std::get<SweptBody>(floor.body);
    double highest = -1.0;
    for (const Vec2 corner : body.section) highest = std::max(highest, corner.x);
    CHECK(std::fabs(highest) < 1e-15);
    double widest = 0.0;
    for (const Vec2 corner : body.section) widest = std::max(widest, std::fabs(corner.y));
    // Half a stave from its middle, at most as far as the round departs by the tolerance there.
    CHECK(widest > 0.0);
    CHECK(build.workshop.notes.size() >= 2);
    const WorkshopBuild again = plates_of(chute(), section::HalfPipe{0.4, 0.05, 4e-3}, options);
    CHECK(again.workshop.parts.size() == build.workshop.parts.size());
  }
}

TEST_CASE("mitred pipe: tubes add up to the pipe along their axes, and both edges of a mitre are one curve") {
  PlateOptions options;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(7.5).radians(), {}, {}};
  const WorkshopBuild build = plates_of(chute(), section::Pipe{0.15, 2e-3}, options);
  double volume = 0.0;
  std::size_t tubes = 0;
  for (const ShopPart& part : build.workshop.parts) {
    if (!part.name.starts_with("tube")) continue;
    ++tubes;
    const auto& gore = std::get<TubeGore>(part.body);
    const double mean = 0.076;
    // The developed area is the circumference times the length of the axis: the sines cancel.
    const double area = moments(part.pattern->region).area;
    CHECK(std::fabs(area / (2.0 * std::numbers::pi * mean * gore.length) - 1.0) < 1e-5);
    CHECK(std::fabs(bounds(part.pattern->region.outline).width() - 2.0 * std::numbers::pi * mean) < 1e-9);
    CHECK(faults_of(part.pattern->region).empty());
    volume += part.volume * static_cast<double>(part.quantity());
  }
  CHECK(tubes == build.ride.bends + 1);
  CHECK(std::fabs(volume / build.proof.volume - 1.0) < 1e-12);
  CHECK(build.proof.edge_mismatch < 1e-9);
}

TEST_CASE(
    "mitred half-pipe: troughs add up to the section along its flats, edges of a mitre are one line from rim "
    "to rim") {
  PlateOptions options;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(7.5).radians(), {}, {}};
  for (const double side : {0.0, 0.06}) {
    const WorkshopBuild build = plates_of(chute(), section::HalfPipe{0.3, side, 3e-3}, options);
    const double mean = 0.1515;
    double volume = 0.0;
    std::size_t troughs = 0;
    for (const ShopPart& part : build.workshop.parts) {
      CHECK(faults_of(part.pattern->region).empty());
      if (!part.name.starts_with("trough_") || part.name.starts_with("trough_flange")) continue;
      ++troughs;
      const auto& gore = std::get<TroughGore>(part.body);
      CHECK(gore.side == side);
      CHECK(std::fabs(bounds(part.pattern->region.outline).width() - (std::numbers::pi * mean + 2.0 * side)) <
            1e-9);
      // The pattern is the middle of the thickness: its area times the thickness misses by what is second order in it.
      CHECK(std::fabs(moments(part.pattern->region).area * 3e-3 / part.volume - 1.0) < 1e-4);
      volume += part.volume * static_cast<double>(part.quantity());
    }
    CHECK(troughs == build.ride.bends + 1);
    CHECK(std::fabs(volume / build.proof.volume - 1.0) < 1e-12);
    CHECK(build.proof.edge_mismatch < 1e-9);
    // Flanges of a joint share their bolts.
    const ShopPart& tight = part_of(build, "trough_flange");
    const ShopPart& loose = part_of(build, "trough_flange_loose");
    REQUIRE(tight.pattern->region.holes.size() == loose.pattern->region.holes.size());
    CHECK(tight.pattern->region.holes.front().centre == loose.pattern->region.holes.front().centre);
  }
}

namespace {

/// Moments of a body by points strewn through a box round it.
parts::BodyMoments strewn(const PartBody& body, Vec3 low, Vec3 size) {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  double inside = 0.0;
  Vec3 sum;
  constexpr int kPoints = 200000;
  for (int k = 0; k < kPoints; ++k) {
    const Vec3 point{low.x + size.x * random.between(0.0, 1.0), low.y + size.y * random.between(0.0, 1.0),
                     low.z + size.z * random.between(0.0, 1.0)};
    if (parts::depth_inside(body, point) <= 0.0) continue;
    inside += 1.0;
    sum = sum + point;
  }
  return {inside / kPoints * size.x * size.y * size.z, (1.0 / inside) * sum};
}

}  // namespace

TEST_CASE("mitred rounds: the moments of a tube and of a trough are those of points strewn through them") {
  const Angle start = Angle::from_radians(0.2);
  const Angle end = Angle::from_radians(-0.15);
  for (const PartBody& body : {PartBody(TubeGore{0.1, 0.02, 0.5, start, end}),
                               PartBody(TroughGore{0.1, 0.02, 0.08, 0.5, start, end})}) {
    const parts::BodyMoments moments = parts::moments(body);
    const parts::BodyMoments found = strewn(body, {-0.12, -0.12, -0.05}, {0.24, 0.24, 0.6});
    CHECK(std::fabs(found.volume / moments.volume - 1.0) < 0.03);
    CHECK(std::fabs(found.centroid.x - moments.centroid.x) < 2e-3);
    CHECK(std::fabs(found.centroid.y) < 3e-3);
    CHECK(std::fabs(found.centroid.z - moments.centroid.z) < 5e-3);
  }
}

TEST_CASE("strips: a point beside an arc that is all but straight is where it is") {
  // Sagitta 1e-13 m: the radius is 5e12 m, and a double there is worth a millimetre.
  const SweptBody body{{{{{0.0, 0.0}, 1e-13}, {{2.0, 0.0}, 0.0}}, false},
                       {{0.0, 0.0}, {0.1, 0.0}, {0.1, 0.2}, {0.0, 0.2}}};
  CHECK(std::fabs(parts::depth_inside(body, {1.0, 0.06, 0.1}) - 0.04) < 1e-8);
  CHECK(std::fabs(parts::depth_inside(body, {1.0, 0.1001, 0.1}) + 1e-4) < 1e-8);
}

TEST_CASE("strips: random tracks and sections make plates that add up, with no clash") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < (testing::thorough() ? 10 : 6); ++run) {
    const ClothoidSpline track = testing::random_track(random, {});
    const double t = random.between(2e-3, 8e-3);
    const double high = random.between(0.1, 0.3);
    const std::vector<section::Measures> kinds = {
        section::Trapezoid{WidthLaw(random.between(0.2, 0.8)), high,
                           Angle::from_degrees(random.between(2.0, 40.0)), t},
        section::VChannel{Angle::from_degrees(random.between(60.0, 120.0)), 0.03, high, t},
        section::Slab{WidthLaw(0.5), t, 0.06, 0.01},
        section::Polygon{{{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.0}, {0.0, 0.0}, {-0.2, 0.0}}},
    };
    PlateOptions options;
    options.split.longest = random.between(0.8, 3.0);
    for (const section::Measures& measures : kinds) {
      INFO(section::kind(measures));
      const WorkshopBuild build =
          plates_of(track, measures, options);  // throws where parts clash or do not add up
      for (const ShopPart& part : build.workshop.parts) {
        CHECK(part.mass > 0.0);
        CHECK(faults_of(part.pattern->region).empty());
      }
    }
    PlateOptions staves = options;
    staves.round = RoundMake::staves;
    CHECK(plates_of(track, section::HalfPipe{random.between(0.2, 0.6), 0.0, t}, staves).proof.pairs > 0);
    PlateOptions pipe = options;
    pipe.bend = {FacetRule::segment_angle, Angle::from_degrees(random.between(4.0, 15.0)).radians(), {}, {}};
    CHECK(plates_of(track, section::Pipe{0.2, t}, pipe).proof.pairs > 0);
    CHECK(plates_of(track, section::HalfPipe{0.3, random.integer(0, 1) * random.between(0.02, 0.2), t}, pipe)
              .proof.pairs > 0);
    pipe.round = RoundMake::staves;
    CHECK(plates_of(track, section::Pipe{0.2, t}, pipe).proof.pairs > 0);
  }
}

TEST_CASE("rounds: those that fit no sheet as troughs become staves, unless troughs are asked for") {
  const section::HalfPipe wide{2.0, 0.0, 4e-3};  // 3.15 m round
  const ClothoidSpline track(Angle::from_degrees(30.0), {{6.0, 0.0, 0.0}, {3.0, 0.02, 0.02}});
  const WorkshopBuild build = plates_of(track, wide);
  CHECK(build.workshop.parts.front().name.find("stave") == 0);
  CHECK(build.workshop.notes.back().find(
            "Staves along the track, since it does not go mitred: a trough takes 3.1") == 0);
  PlateOptions mitred;
  mitred.round = RoundMake::mitred;
  try {
    (void)plates_of(track, wide, mitred);
    FAIL("a trough of 3.15 m came out of a sheet of 3 m");
  } catch (const InputError& error) {
    CHECK(error.issues().front().where == "split");
    CHECK(error.issues().front().why.find(
              "Shorter units do not make it smaller, and the sheet is 3 m x 1.5 m") == 0);
  }
}

TEST_CASE("strips: what cannot be made is refused with place, value and bound") {
  const auto refusal = [](const section::Measures& measures, const PlateOptions& options,
                          const Centerline& track) {
    return refusal_of([&] { return plates_of(track, measures, options); });
  };
  // A hollow of 0.3 m in the middle, walls of 0.4 m.
  const ClothoidSpline hollow(Angle::from_degrees(60.0),
                              {{1.0, 0.0, 0.0}, {0.2, 1.0 / 0.3, 1.0 / 0.3}, {1.0, 0.0, 0.0}});
  const section::Trapezoid high{WidthLaw(0.4), 0.4, Angle::from_degrees(20.0), 4e-3};
  const std::string fold = refusal(high, {}, hollow);
  CHECK(fold.find("cross_section|the left_wall folds over at 1 m along the track|") == 0);
  CHECK(fold.find("the radius there 300 mm") != std::string::npos);
  CHECK(fold.find("a section of at most 294 mm") != std::string::npos);
  const section::Polygon thin{{{-0.2, -6e-3}, {0.2, -6e-3}, {0.2, 0.0}, {0.0, 0.0}, {-0.2, 0.0}}};
  PlateOptions thick;
  thick.polygon_thickness = 4e-3;
  CHECK(refusal(thin, thick, chute()).find("thickness|thickness: ") == 0);
}

TEST_CASE(
    "strips: frames clear staves that begin close behind them, at a vertical start; a gap that was told is "
    "refused") {
  const CoulombBrachistochrone steep{{3.5, 2.6}, kFriction};
  const section::Measures pipe = section::Pipe{0.411, 3e-3};
  // The section bends out of the usual gap within the frame at the start.
  const CoulombBrachistochrone tight{{3.5, 2.6}, Friction::from_angle(Angle::from_degrees(10.0))};
  PlateOptions usual;
  usual.round = RoundMake::staves;
  usual.stave_tolerance = 19e-3;
  CHECK(named(plates_of(tight, pipe, usual), "end_frame").size() >= 2);
  for (const double tolerance : {0.010, 0.019, 0.025}) {
    INFO("staves to " << tolerance << " m");
    PlateOptions options;
    options.round = RoundMake::staves;
    options.stave_tolerance = tolerance;
    options.split.longest = 1.2;
    const WorkshopBuild build = plates_of(steep, pipe, options);
    CHECK(named(build, "end_frame").size() >= 2);
    CHECK(build.proof.pairs > 10);
    // Such a start closes the usual gap: told, it is refused with one that does.
    options.flanges.as_told = true;
    const std::string told = refusal_of([&] { return plates_of(steep, pipe, options); });
    CHECK(
        told.find(
            "flanges.gap|gap: 0.5 mm is closed by plates that begin or bend behind a frame, at 0 mm along") ==
        0);
    const std::size_t hint = told.find("|gap: ", told.find("out of the section there."));
    REQUIRE(hint != std::string::npos);
    options.flanges.gap = 1e-3 * std::stod(told.substr(hint + 6));
    CHECK(plates_of(steep, pipe, options).proof.pairs == build.proof.pairs);
  }
}

TEST_CASE("strips: faces of staves that stand upright but for rounding are planes and cylinders, no cones") {
  PlateOptions options;
  options.round = RoundMake::staves;
  std::size_t cones = 0;
  for (const double width : {0.5, 0.601, 0.691, 0.737, 0.83}) {
    const WorkshopBuild build = plates_of(chute(), section::HalfPipe{width, 0.375, 6e-3}, options);
    for (const ShopPart& part : build.workshop.parts) {
      for (const parts::BrepFace& face : parts::brep_of(part).faces) {
        if (face.kind != parts::SurfaceKind::cone) continue;
        ++cones;
        INFO(part.name);
        CHECK(face.half_angle > 1e-6);
        CHECK(face.half_angle < 0.5 * std::numbers::pi - 1e-6);
      }
    }
  }
  CHECK(cones > 100);
}

}  // namespace strips_test
