// Inspection openings of mitred tubes and troughs.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/bodies/tube_windows.hpp"
#include "parts/bolt_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/curves/nearest_place.hpp"
#include "parts/random_tracks.hpp"
#include "parts/refusals.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace {

using namespace glissade;
using namespace testing;

constexpr double kDegree = std::numbers::pi / 180.0;

PlateOptions with_opening(double at, double length, double height) {
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.inspection = {{at, length, height, 6}};
  return options;
}

std::vector<const ShopPart*> opened_tubes(const WorkshopBuild& build) {
  std::vector<const ShopPart*> found;
  for (const ShopPart& part : build.workshop.parts) {
    const auto* const tube = std::get_if<TubeGore>(&part.body);
    if (tube != nullptr && !tube->windows.empty()) found.push_back(&part);
  }
  return found;
}

/// A place of a tube's middle circumference on its pattern: straight lines run on at every angle, from the lower edge.
double level_of(const TubeGore& tube, Angle about, double along) {
  const double mean = tube.inner_radius + 0.5 * tube.thickness;
  return along - mean * std::cos(about.radians()) * std::tan(tube.start_tilt.radians());
}

/// Height of a pattern's lower edge at a place across.
double lower_edge(const ArcPath& outline, double x) {
  double low = 1e9;
  for (const PathPiece& piece : pieces_of(outline)) {
    if (std::min(piece.from.x, piece.to.x) > x || std::max(piece.from.x, piece.to.x) < x) continue;
    double from = 0.0;
    double to = 1.0;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (from + to);
      ((point_on(piece, middle).x < x) == (piece.from.x < piece.to.x) ? from : to) = middle;
    }
    low = std::min(low, point_on(piece, from).y);
  }
  return low;
}

}  // namespace

TEST_CASE(
    "tube openings: a tube with a window and holes has the volume and middle of points strewn through it") {
  const TubeGore tube = opened_tube();
  const parts::BodyMoments all = parts::moments(tube);
  TubeGore plain = tube;
  plain.windows.clear();
  plain.holes.clear();
  // Developed at the middle of the thickness.
  const double window = 0.1015 * 50.0 * kDegree * 0.15 * 0.003;
  const double holes = 4.0 * std::numbers::pi * 4.5e-3 * 4.5e-3 * 0.003;
  CHECK(std::fabs((parts::moments(plain).volume - all.volume) / (window + holes) - 1.0) < 1e-4);
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  double inside = 0.0;
  Vec3 sum;
  constexpr int kPoints = 100000;
  for (int k = 0; k < kPoints; ++k) {
    // Evenly through the wall of a tube that is longer.
    const double radius = std::sqrt(random.between(0.1 * 0.1, 0.103 * 0.103));
    const double angle = random.between(0.0, 2.0 * std::numbers::pi);
    const Vec3 point{radius * std::cos(angle), radius * std::sin(angle), random.between(-0.02, 0.52)};
    if (!(parts::depth_inside(tube, point) > 0.0)) continue;
    inside += 1.0;
    sum = sum + point;
  }
  const double whole = std::numbers::pi * (0.103 * 0.103 - 0.01) * 0.54;
  CHECK(std::fabs(inside / kPoints * whole / (all.volume + holes) - 1.0) < 0.01);
  CHECK(std::fabs(sum.x / inside - all.centroid.x) < 2e-3);
  CHECK(std::fabs(sum.y / inside - all.centroid.y) < 2e-3);
  CHECK(std::fabs(sum.z / inside - all.centroid.z) < 4e-3);
  for (const double tolerance : {1e-3, 1e-5}) {
    const TriangleMesh mesh = parts::facets_of(tube, tolerance);
    const MeshFacts facts = measure(mesh);
    CHECK(facts.boundary_edges + facts.non_manifold_edges + facts.self_intersections == 0);
    CHECK(facts.oriented_outward);
    CHECK(std::fabs(facts.volume / all.volume - 1.0) < (tolerance > 1e-4 ? 0.05 : 5e-4));
  }
  for (const Vec3 point : parts::points_beside(tube, 20e-6)) {
    const double depth = parts::depth_inside(tube, point);
    CHECK(depth > 15e-6);
    CHECK(depth < 25e-6);
  }
}

TEST_CASE(
    "tube openings: each lies in one tube on the left, its lid bolted on, the rest of the plates as before") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int made = 0;
  for (int round = 0; round < 8; ++round) {
    const double diameter = random.between(0.25, 0.5);
    const section::Pipe pipe{diameter, random.between(2e-3, 4e-3)};
    const ClothoidSpline track =
        random_track(random, {.smallest = 6.0, .largest = 9.0, .bends = 2, .crest = -0.2, .valley = 0.4});
    PlateOptions options =
        with_opening(random.between(0.2, 0.8) * track.length(), random.between(0.08, 0.15), 0.3 * diameter);
    options.bend = {FacetRule::segment_angle, 6.0 * kDegree, {}, {}};
    options.flanges.wanted = random.integer(0, 2) > 0;
    if (random.integer(0, 1) == 1) options.stiffeners = StiffenerOptions();
    if (random.integer(0, 1) == 1) options.lifting = LiftingOptions();
    if (options.flanges.wanted && random.integer(0, 1) == 1) {
      options.flanges.section = FlangeSection::angle;
      options.flanges.thickness = 5e-3;
    }
    WorkshopBuild build;
    const std::string text = refusal_of([&] { build = plates_of(track, pipe, options); });
    if (!text.empty()) {
      // Across a mitre: the place that is told does.
      INFO(text);
      const std::size_t hint = text.find("|at: ", text.find("lies across"));
      REQUIRE(hint != std::string::npos);
      std::size_t unit = 0;
      const double value = std::stod(text.substr(hint + 5), &unit);
      const bool metres = text[hint + 5 + unit + 1] == 'm' && text[hint + 5 + unit + 2] != 'm';
      options.inspection.front().at = metres ? value : 1e-3 * value;
      build = plates_of(track, pipe, options);
    }
    const std::vector<const ShopPart*> tubes = opened_tubes(build);
    REQUIRE(tubes.size() == 1);
    ++made;
    const auto& tube = std::get<TubeGore>(tubes.front()->body);
    const ShopPart& lid = part_of(build, "lid");
    CHECK(lid.quantity() == 1);
    CHECK(lid.centre_of_gravity.y > 0.4 * diameter);  // to the left of the run
    CHECK(build.proof.bolted >= tube.holes.size());
    PlateOptions without = options;
    without.inspection.clear();
    const WorkshopBuild plain = plates_of(track, pipe, without);
    double cut = 0.0;
    for (const VolumeDifference& difference : build.proof.differences) cut += difference.volume;
    CHECK(std::fabs(plain.proof.volume + cut - build.proof.volume) < 1e-9 * plain.proof.volume);
    CHECK(cut < 0.0);
    // On the flat: as far from the lower edge as in the tube, by arcs that keep to their tolerance.
    const PlaneRegion& flat = tubes.front()->pattern->region;
    CHECK(faults_of(flat).empty());
    REQUIRE(flat.cutouts.size() == 1);
    REQUIRE(flat.holes.size() == tube.holes.size());
    const PlaneBox window = bounds(flat.cutouts.front());
    const double mean = tube.inner_radius + 0.5 * tube.thickness;
    const TubeWindow& own = tube.windows.front();
    CHECK(std::fabs(window.width() - mean * (own.high.radians() - own.low.radians())) < 1e-12);
    CHECK(std::fabs(window.height() - (own.to - own.from)) < 1e-12);
    for (std::size_t k = 0; k < flat.holes.size(); ++k) {
      const Vec2 at = flat.holes[k].centre;
      const TubeHole& hole = tube.holes[k];
      CHECK(std::fabs(at.y - lower_edge(flat.outline, at.x) - level_of(tube, hole.about, hole.along)) <
            30e-6);
      // Seen from inside, what is nearer to the crown on the left stands farther to the left.
      CHECK(std::fabs(window.high.x - at.x - mean * (hole.about.radians() - own.low.radians())) < 1e-9);
    }
  }
  CHECK(made == 8);
}

TEST_CASE("tube openings: what fits no tube is told with the length, height or place that does") {
  const section::Pipe pipe{0.3, 3e-3};
  const ClothoidSpline track(Angle::from_degrees(50.0), {{3.0, 0.3, 0.3}});
  PlateOptions options = with_opening(1.0, 0.1, 0.1);
  options.bend = {FacetRule::segment_angle, 8.0 * kDegree, {}, {}};
  const auto refused = [&] { return refusal_of([&] { return plates_of(track, pipe, options); }); };
  options.inspection.front().height = 0.3;
  const std::string high = refused();
  CHECK(high.find("inspection|height: 300 mm leaves too little of a tube of 306 mm|") == 0);
  CHECK(high.find("|height: 260 mm\n") != std::string::npos);
  options.inspection.front().height = 0.26;
  CHECK(refused().find("height") == std::string::npos);
  options.inspection.front() = {1.0, 0.6, 0.1, 6};
  const std::string longer = refused();
  CHECK(longer.find(
            "inspection|length: an opening of 600 mm fits no tube|With its lid it is 660 mm long; between "
            "mitres and flanges ") == 0);
  const std::size_t hint = longer.find("|length: ", 20);
  REQUIRE(hint != std::string::npos);
  options.inspection.front().length = 1e-3 * std::stod(longer.substr(hint + 9));
  const std::string told = refused();
  CHECK((told.empty() || told.find("lies across a mitre or a flange") != std::string::npos));
  options.inspection.front() = {4.0, 0.1, 0.1, 6};
  CHECK(refused() == "inspection|at: an opening at 4 m is not on the track|It is 3 m long.|at: 1.5 m\n");
  options.inspection = {{1.0, 0.1, 0.1, 6}, {1.02, 0.1, 0.1, 6}};
  CHECK(refused().find("inspection|at: openings at 1 m and 1.02 m are too close|") == 0);
  options.inspection = {{1.0, 0.1, 0.1, 6}, {1.02, 0.1, 0.1, 6}, {2.0, 0.6, 0.1, 6}};
  CHECK(refused().find("inspection|at: openings at 1 m and 1.02 m are too close|") == 0);
  CHECK(refused().find("\ninspection|length: an opening of 600 mm fits no tube|") != std::string::npos);
  options.inspection = {{1.0, 0.1, 0.1, 24}};
  const section::Pipe narrow{0.07, 3e-3};
  CHECK(refusal_of([&] {
          return plates_of(track, narrow, options);
        }).find("bolt: M24 is too large for a tube of 76 mm") != std::string::npos);
  // Left to what fits, a pipe whose opening is too high for tubes is staves.
  options.inspection = {{1.0, 0.1, 0.1, 6}};
  options.round = RoundMake::as_fits;
  CHECK(opened_tubes(plates_of(track, pipe, options)).size() == 1);
  // Tubes too short and staves too narrow for it: what is told is of tubes.
  options = with_opening(1.0, 0.1, 0.1);
  options.round = RoundMake::as_fits;
  CHECK(refused().find("inspection|length: an opening of 100 mm fits no tube|") == 0);
}

TEST_CASE("tube openings: a lid that is turned on its tube is found out by its holes") {
  PlateOptions options = with_opening(1.0, 0.1, 0.1);
  const ClothoidSpline track(Angle::from_degrees(50.0), {{3.0, 0.1, 0.1}});
  const WorkshopBuild build = plates_of(track, section::Pipe{0.3, 3e-3}, options);
  CHECK(bolt_fault(build.workshop).empty());
  Workshop workshop = build.workshop;
  for (ShopPart& part : workshop.parts) {
    if (part.name != "lid") continue;
    part.places.front().origin = part.places.front().origin + 1e-3 * part.places.front().z;
  }
  CHECK(bolt_fault(workshop).find("off the axis of that in") != std::string::npos);
}

namespace {

/// A trough opened as tubes are, on its left.
TroughGore opened_trough(double side) {
  TroughGore trough{0.15, 0.003, side, 0.5, Angle::from_degrees(6.0), Angle::from_degrees(-4.0)};
  trough.windows = {{0.2, 0.3, Angle::from_degrees(-150.0), Angle::from_degrees(-110.0)}};
  for (const double along : {0.18, 0.32}) {
    for (const double about : {-156.0, -104.0})
      trough.holes.push_back({along, Angle::from_degrees(about), 4.5e-3});
  }
  return trough;
}

}  // namespace

TEST_CASE("tube openings: an opened trough is a solid less its window and holes, by facets and by depth") {
  for (const double side : {0.0, 0.08}) {
    INFO("sides of " << side);
    const TroughGore trough = opened_trough(side);
    const parts::BodyMoments all = parts::moments(trough);
    TroughGore plain = trough;
    plain.windows.clear();
    plain.holes.clear();
    const double window = 0.1515 * 40.0 * kDegree * 0.1 * 0.003;
    const double holes = 4.0 * std::numbers::pi * 4.5e-3 * 4.5e-3 * 0.003;
    CHECK(std::fabs((parts::moments(plain).volume - all.volume) / (window + holes) - 1.0) < 1e-4);
    for (const double tolerance : {1e-3, 1e-5}) {
      const MeshFacts facts = measure(parts::facets_of(trough, tolerance));
      CHECK(facts.boundary_edges + facts.non_manifold_edges + facts.self_intersections == 0);
      CHECK(facts.oriented_outward);
      CHECK(std::fabs(facts.volume / all.volume - 1.0) < (tolerance > 1e-4 ? 0.05 : 5e-4));
    }
    for (const Vec3 point : parts::points_beside(parts::round_of(trough), 20e-6)) {
      const double depth = parts::depth_inside(trough, point);
      CHECK(depth > 15e-6);
      CHECK(depth < 25e-6);
    }
  }
}

TEST_CASE(
    "tube openings: along straights they are where they are asked for, and mitres are set out in the bend") {
  const ClothoidSpline track(Angle::from_degrees(60.0), {{1.4, 0.0}, {1.4, 0.25}, {1.5, 0.0}});
  for (const double asked : {0.5, 0.9, 3.6}) {
    INFO("asked " << asked);
    PlateOptions options = with_opening(asked, 0.1, 0.1);
    options.bend = {FacetRule::segment_angle, Angle::from_degrees(10.0).radians(), {}, {}};
    const WorkshopBuild build = plates_of(track, section::Pipe{0.25, 3e-3}, options);
    const ArcSpline& line = *build.master.spline;
    REQUIRE(opened_tubes(build).size() == 1);
    const ShopPart& tube = *opened_tubes(build).front();
    const TubeWindow& window = std::get<TubeGore>(tube.body).windows.front();
    const Vec3 at = tube.places.front().to_space({0.0, 0.0, 0.5 * (window.from + window.to)});
    const double found = parts::nearest_place(line, {0.0, line.length()}, {at.x, at.z}).s;
    CHECK(found == Approx(asked).margin(1e-6));
    int mitres = 0;
    for (const SettingOutPoint& point : build.workshop.setting_out) {
      if (point.what.find("mitre ") != 0) continue;
      ++mitres;
      CHECK(point.arc_length > 1.4);
      CHECK(point.arc_length < 2.8);
    }
    CHECK(mitres == 2);
  }
}

TEST_CASE(
    "tube openings: several of any heights and bolts in one tube or trough leave a solid of their volume") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < (testing::thorough() ? 12 : 2); ++round) {
    TroughGore trough{random.between(0.1, 0.4),
                      random.between(2e-3, 5e-3),
                      0.0,
                      0.0,
                      Angle::from_degrees(random.between(-8.0, 8.0)),
                      Angle::from_degrees(random.between(-8.0, 8.0))};
    if (random.integer(0, 1) == 0) trough.side = random.between(0.02, 0.2);
    // One after the other, lids end to end or apart; all on the left, their upper ends on one line.
    double along = 0.1;
    const int openings = random.integer(2, 3);
    for (int k = 0; k < openings; ++k) {
      const double lap = 30e-3;
      const double outer = trough.inner_radius + trough.thickness;
      const double high = -1.8;
      const double low = high - random.between(0.05, 0.9);
      const double from = along + lap;
      const double to = from + random.between(0.05, 0.2);
      trough.windows.push_back({from, to, Angle::from_radians(low), Angle::from_radians(high)});
      const double radius = 1e-3 * random.between(2.5, 5.5);
      for (const double angle : {low - 0.5 * lap / outer, high + 0.5 * lap / outer}) {
        for (const double z : {from - 0.5 * lap, 0.5 * (from + to), to + 0.5 * lap})
          trough.holes.push_back({z, Angle::from_radians(angle), radius});
      }
      along = to + lap + (random.integer(0, 1) == 0 ? 0.0 : random.between(0.0, 0.2));
    }
    trough.length = along + 0.1;
    const auto check = [&](const auto& body) {
      const double volume = parts::moments(body).volume;
      for (const double tolerance : {1e-3, 1e-5}) {
        const MeshFacts facts = measure(parts::facets_of(body, tolerance));
        CHECK(facts.boundary_edges + facts.non_manifold_edges + facts.self_intersections == 0);
        CHECK(facts.oriented_outward);
        CHECK(std::fabs(facts.volume / volume - 1.0) < (tolerance > 1e-4 ? 0.05 : 5e-4));
      }
    };
    CAPTURE(round, openings, trough.side);
    check(trough);
    check(parts::round_of(trough));
  }
}

TEST_CASE("tube openings: each lies in one trough on the left, off its rim, its lid bolted on") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const TempDir dir;
  int made = 0;
  for (int round = 0; round < 8; ++round) {
    const double width = random.between(0.4, 0.7);
    const section::HalfPipe half{width, random.integer(0, 1) == 0 ? 0.0 : random.between(0.02, 0.2),
                                 random.between(2e-3, 4e-3)};
    const ClothoidSpline track =
        random_track(random, {.smallest = 6.0, .largest = 9.0, .bends = 2, .crest = -0.15, .valley = 0.2});
    PlateOptions options =
        with_opening(random.between(0.2, 0.8) * track.length(), random.between(0.08, 0.15), 0.2 * width);
    options.bend = {FacetRule::segment_angle, 6.0 * kDegree, {}, {}};
    if (random.integer(0, 1) == 0) options.rim = RimOptions();
    if (random.integer(0, 1) == 0) options.stiffeners = StiffenerOptions();
    // Left to what fits, troughs take them, too.
    if (random.integer(0, 1) == 0) options.round = RoundMake::as_fits;
    WorkshopBuild build;
    CAPTURE(round, width, half.wall_height, options.rim.has_value());
    const std::string text = refusal_of([&] { build = plates_of(track, half, options); });
    if (!text.empty()) {
      INFO(text);
      const std::size_t hint = text.find("|at: ", text.find("lies across"));
      REQUIRE(hint != std::string::npos);
      std::size_t unit = 0;
      const double value = std::stod(text.substr(hint + 5), &unit);
      const bool metres = text[hint + 5 + unit + 1] == 'm' && text[hint + 5 + unit + 2] != 'm';
      options.inspection.front().at = metres ? value : 1e-3 * value;
      build = plates_of(track, half, options);
    }
    const ShopPart* opened = nullptr;
    for (const ShopPart& part : build.workshop.parts) {
      const auto* const trough = std::get_if<TroughGore>(&part.body);
      if (trough != nullptr && !trough->windows.empty()) opened = &part;
    }
    // Staves, where troughs would be too short.
    if (opened == nullptr) continue;
    ++made;
    const auto& trough = std::get<TroughGore>(opened->body);
    const ShopPart& lid = part_of(build, "lid");
    CHECK(lid.centre_of_gravity.y > 0.1 * width);  // to the left of the run
    CHECK(build.proof.bolted >= trough.holes.size());
    PlateOptions without = options;
    without.inspection.clear();
    const WorkshopBuild plain = plates_of(track, half, without);
    double cut = 0.0;
    for (const VolumeDifference& difference : build.proof.differences) cut += difference.volume;
    CHECK(std::fabs(plain.proof.volume + cut - build.proof.volume) < 1e-9 * plain.proof.volume);
    CHECK(cut < 0.0);
    const PlaneRegion& flat = opened->pattern->region;
    CHECK(faults_of(flat).empty());
    REQUIRE(flat.cutouts.size() == 1);
    REQUIRE(flat.holes.size() == trough.holes.size());
    const double mean = trough.inner_radius + 0.5 * trough.thickness;
    const TubeWindow& own = trough.windows.front();
    CHECK(std::fabs(bounds(flat.cutouts.front()).width() - mean * (own.high.radians() - own.low.radians())) <
          1e-12);
    // From the left rim.
    CHECK(std::fabs(bounds(flat.cutouts.front()).low.x -
                    (half.wall_height + mean * (-0.5 * std::numbers::pi - own.high.radians()))) < 1e-12);
    write_step(dir.path() / "part.step", *opened);
    require_same_step(dir.path() / "part.step", *opened);
  }
  CHECK(made >= 5);
}

TEST_CASE("tube openings: what fits no trough is told with what does") {
  const ClothoidSpline track(Angle::from_degrees(50.0), {{3.0, 0.2, 0.2}});
  PlateOptions options = with_opening(1.0, 0.1, 0.4);
  options.bend = {FacetRule::segment_angle, 8.0 * kDegree, {}, {}};
  options.rim = RimOptions();
  const section::HalfPipe half{0.5, 0.0, 3e-3};
  const auto refused = [&] { return refusal_of([&] { return plates_of(track, half, options); }); };
  const std::string high = refused();
  CHECK(high.find("inspection|height: 400 mm leaves too little of a trough of 506 mm|") == 0);
  const std::size_t hint = high.find("|height: ", 20);
  REQUIRE(hint != std::string::npos);
  options.inspection.front().height = 1e-3 * std::stod(high.substr(hint + 9));
  CHECK(refused().find("leaves too little") == std::string::npos);
  options.inspection.front() = {1.0, 1.6, 0.1, 6};
  CHECK(refused().find("inspection|length: an opening of 1.6 m fits no trough|") == 0);
}
