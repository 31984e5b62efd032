// Plates beside a width that changes: walls lean so that they unroll without strain, floors taper, all add up.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_edges.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "parts/bodies/body_moments.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace widths_test {

namespace {

using namespace glissade;
using namespace testing;

constexpr double kPi = std::numbers::pi;
const WidthLaw kWidening({{2.0, 0.4}, {4.0, 0.6}, {6.0, 0.35}});

PlateOptions in_one_piece() {
  PlateOptions options;
  options.split.sheet = {20.0, 8.0};
  return options;
}

/// The middle of two corners of a section at a share of a piece of the body's path.
Vec3 middle_of(const SweptBody& body, std::size_t piece, double share, std::size_t one, std::size_t other) {
  const PathPiece path = pieces_of(body.path)[piece];
  const Vec2 at = point_on(path, share);
  const Vec2 chord = path.to - path.from;
  const auto [sine, cosine] = math::sine_cosine(4.0 * math::atan(path.bulge) * (share - 0.5));
  const Vec2 along =
      (1.0 / norm(chord)) * Vec2{cosine * chord.x - sine * chord.y, sine * chord.x + cosine * chord.y};
  const auto corner = [&](std::size_t j) {
    const double shift = (1.0 - share) * body.shifts[piece][j] + share * body.shifts[piece + 1][j];
    const Vec2 here = at + body.section[j].x * Vec2{-along.y, along.x};
    return Vec3{here.x, here.y, body.section[j].y + shift};
  };
  return 0.5 * (corner(one) + corner(other));
}

/// A strip between two lines laid flat triangle by triangle.
struct Unfolded {
  std::vector<Vec2> base;
  std::vector<Vec2> upper;
};

Vec2 apex(Vec2 a, Vec2 b, double from_a, double from_b) {
  const double side = norm(b - a);
  const double along = (from_a * from_a - from_b * from_b + side * side) / (2.0 * side);
  const double up = std::sqrt(std::max(0.0, from_a * from_a - along * along));
  const Vec2 unit = (1.0 / side) * (b - a);
  return a + along * unit + up * Vec2{-unit.y, unit.x};
}

Unfolded unfolded(const std::vector<Vec3>& base, const std::vector<Vec3>& upper) {
  Unfolded flat;
  flat.base.push_back({});
  flat.upper.push_back({0.0, norm(upper[0] - base[0])});
  for (std::size_t i = 0; i + 1 < base.size(); ++i) {
    // Left of upper -> base lies the next pair.
    const Vec2 next =
        apex(flat.upper.back(), flat.base.back(), norm(base[i + 1] - upper[i]), norm(base[i + 1] - base[i]));
    const Vec2 above =
        apex(flat.upper.back(), next, norm(upper[i + 1] - upper[i]), norm(upper[i + 1] - base[i + 1]));
    flat.base.push_back(next);
    flat.upper.push_back(above);
  }
  return flat;
}

}  // namespace

TEST_CASE("widths: a wall laid flat triangle by triangle is its pattern") {
  const double t = 4e-3;
  PlateOptions options = in_one_piece();
  // Bends about a neutral fibre in the middle, as sharp as they may be, take next to nothing of the flat.
  options.bend.inner_radius = t;
  options.bend.k_factor = 0.5;
  for (const bool left : {true, false}) {
    const WorkshopBuild build = plates_of(chute(), section::UChannel{kWidening, 0.25, t}, options);
    const ShopPart& wall = part_of(build, left ? "left_wall" : "right_wall");
    const auto& body = std::get<SweptBody>(wall.body);
    // Corners: face_from, face_to, back_to, back_from.
    std::vector<Vec3> base;
    std::vector<Vec3> upper;
    constexpr int kSteps = 60;
    const std::size_t pieces = body.path.vertices.size() - 1;
    for (std::size_t i = 0; i < pieces; ++i) {
      for (int k = 0; k < kSteps || (i + 1 == pieces && k == kSteps); ++k) {
        base.push_back(middle_of(body, i, static_cast<double>(k) / kSteps, 1, 2));
        upper.push_back(middle_of(body, i, static_cast<double>(k) / kSteps, 0, 3));
      }
    }
    const Unfolded flat = unfolded(base, upper);
    const auto& corners = wall.pattern->region.outline.vertices;
    REQUIRE(corners.size() == 2 * (pieces + 1));
    // Distances of every corner from the first ones, whichever way the pattern lies.
    double worst = 0.0;
    for (std::size_t i = 0; i <= pieces; ++i) {
      const std::size_t k = std::min(i * kSteps, flat.base.size() - 1);
      const Vec2 low = corners[i].at;
      const Vec2 high = corners[2 * pieces + 1 - i].at;
      const Vec2 from = corners.front().at;
      const Vec2 over = corners.back().at;
      worst = std::max({worst, std::fabs(norm(low - from) - norm(flat.base[k] - flat.base[0])),
                        std::fabs(norm(high - from) - norm(flat.upper[k] - flat.base[0])),
                        std::fabs(norm(low - over) - norm(flat.base[k] - flat.upper[0])),
                        std::fabs(norm(high - over) - norm(flat.upper[k] - flat.upper[0]))});
    }
    double taken = 0.0;
    for (const BendLine& bend : wall.pattern->bends) {
      const double half = 0.5 * bend.angle.radians();
      taken += 2.0 * (t + 0.5 * t) * (std::tan(half) - half);
    }
    CHECK(taken < 1e-5);
    CHECK(worst < 2e-6 + taken);
    CHECK(wall.pattern->bends.size() == 3);
  }
}

TEST_CASE(
    "widths: plates add up to the solid but for what leaning adds, and edges that meet have one length") {
  for (const section::Measures& measures :
       {section::Measures(section::UChannel{kWidening, 0.25, 4e-3}),
        section::Measures(section::Trapezoid{kWidening, 0.2, Angle::from_degrees(20.0), 4e-3}),
        section::Measures(section::Slab{kWidening, 6e-3})}) {
    const WorkshopBuild build = plates_of(chute(), measures);
    const ArcSpline& line = *build.master.spline;
    // Area and moment of the design's own section at the middle of many short stretches.
    REQUIRE(build.proof.differences.size() == 1);
    CHECK(std::fabs(build.proof.differences.front().volume) < 1e-3 * build.proof.exact_volume);
    CHECK(build.proof.edge_mismatch < 1e-9);
    double floor = 0.0;
    for (const ShopPart& part : build.workshop.parts) {
      if (part.name.starts_with("floor")) floor += moments(part.pattern->region).area;
    }
    // The floor's mid-plane: its width over its own length.
    double exact = 0.0;
    constexpr int kSteps = 40000;
    const bool trapezoid = std::holds_alternative<section::Trapezoid>(measures);
    const double more = trapezoid ? 4e-3 * math::tan(Angle::from_degrees(35.0).radians()) : 0.0;
    const double half = std::holds_alternative<section::Slab>(measures) ? 3e-3 : 2e-3;
    for (int k = 0; k < kSteps; ++k) {
      const double s = line.length() * (k + 0.5) / kSteps;
      exact += line.length() / kSteps * (kWidening.at(s) + more) * (1.0 + half * line.at(s).curvature);
    }
    CHECK(std::fabs(floor / exact - 1.0) < 2e-4);
  }
}

TEST_CASE("widths: a width that is one everywhere makes the plates of one width") {
  const WidthLaw same({{1.0, 0.4}, {3.0, 0.4 + 1e-9}});
  const WorkshopBuild widening = plates_of(chute(), section::UChannel{same, 0.25, 4e-3});
  const WorkshopBuild plain = plates_of(chute(), section::UChannel{WidthLaw(0.4), 0.25, 4e-3});
  CHECK(std::fabs(widening.proof.volume / plain.proof.volume - 1.0) < 1e-8);
  CHECK(std::fabs(widening.proof.differences.front().volume) < 1e-12);
}

TEST_CASE(
    "widths: bodies are closed, in facets and in STEP, and splines stand only where the width changes in a "
    "bend") {
  const TempDir dir;
  const WorkshopBuild build = plates_of(chute(), section::UChannel{kWidening, 0.25, 4e-3});
  std::size_t splines = 0;
  for (const ShopPart& part : build.workshop.parts) {
    write_step(dir.path() / "part.step", part);
    require_same_step(dir.path() / "part.step", part);
    splines += read_step_facts(dir.path() / "part.step").solids.front().splines;
    const TriangleMesh mesh = parts::facets_of(part.body, 1e-5);
    CHECK(std::fabs(measure(mesh).volume / part.volume - 1.0) < 1e-3);
  }
  CHECK(splines > 10);
  for (const ShopPart& part :
       plates_of(chute(), section::UChannel{WidthLaw(0.4), 0.25, 4e-3}).workshop.parts) {
    write_step(dir.path() / "part.step", part);
    CHECK(read_step_facts(dir.path() / "part.step").solids.front().splines == 0);
  }
}

TEST_CASE(
    "widths: where the width begins or ends to change walls are pressed about the punch, rolled or bent") {
  const WidthLaw widths(std::vector<WidthAt>{{1.0, 0.6}, {2.5, 0.4}});
  const double t = 4e-3;
  const section::UChannel channel{widths, 0.2, t};
  const double angle = std::atan(0.1 / 1.5);  // of one side
  PlateOptions options = in_one_piece();
  options.flanges.wanted = false;
  const StraightLine line(Endpoints{4.0, 3.0});
  for (const auto& [floor, radius] : std::vector<std::pair<FloorMake, double>>{{FloorMake::rolled, t},
                                                                               {FloorMake::rolled, 10e-3},
                                                                               {FloorMake::rolled, 40e-3},
                                                                               {FloorMake::bent, t},
                                                                               {FloorMake::bent, 10e-3},
                                                                               {FloorMake::bent, 40e-3}}) {
    const bool bent = floor == FloorMake::bent;
    CAPTURE(bent, radius);
    options.floor = floor;
    options.bend.inner_radius = radius;
    const WorkshopBuild build = plates_of(line, channel, options);
    // Both walls of bent plates are one part.
    const ShopPart& wall = part_of(build, bent ? "wall" : "left_wall");
    REQUIRE(wall.pattern->bends.size() == 2);
    for (const BendLine& bend : wall.pattern->bends) {
      CHECK(bend.inner_radius == radius);
      CHECK(bend.angle.radians() == Approx(angle).epsilon(1e-9));
    }
    CHECK(wall.pattern->bends[0].up != wall.pattern->bends[1].up);
    // Sides in the middle of the thickness, less what two bends take of them: (r + K t) a for 2 (r + t/2) tan(a/2).
    const double side = 5.0 - 1.5 + math::hypot(1.5, 0.1);
    const double taken =
        2.0 * (radius + 0.5 * t) * std::tan(0.5 * angle) - (radius + k_factor(radius, t) * t) * angle;
    CHECK(taken > 0.0);
    CHECK(bounds(wall.pattern->region.outline).width() == Approx(side - 2.0 * taken).margin(1e-9));
    double sum = 0.0;
    std::vector<double> places;
    for (const BendStep& step : build.workshop.bends) {
      if (step.part != wall.number) continue;
      CHECK(step.radius == radius);
      CHECK(step.length == 0.0);
      places.push_back(step.distance);
      CHECK(step.hit == static_cast<int>(places.size()));
      sum += step.angle.radians();
      CHECK(step.sum.radians() == Approx(sum).margin(1e-12));
    }
    REQUIRE(places.size() == 2);
    CHECK(sum == Approx(0.0).margin(1e-12));
    CHECK(places[0] == Approx(1.0 - 0.5 * taken).margin(2e-6));
    CHECK(places[1] - places[0] == Approx(math::hypot(1.5, 0.1) - taken).margin(2e-6));
    // Judged as bends; nothing is rolled on a straight track.
    std::size_t bends = 0;
    for (const ShopMeasurement& one : build.workshop.measured) {
      CHECK(one.quantity != "rolling_radius_thicknesses");
      if (one.quantity != "bend_radius_thicknesses") continue;
      CHECK(one.in_units() == Approx(radius / t));
      ++bends;
    }
    CHECK(bends >= 2);
  }
  const WidthLaw whole(std::vector<WidthAt>{{0.0, 0.6}, {5.0, 0.4}});
  for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
    options.floor = floor;
    options.bend.inner_radius = 3e-3;
    CHECK(refusal_of([&] {
            return plates_of(line, channel, options);
          }).find("bend.inner_radius|inner_radius: 3 mm is less than the plate's thickness") == 0);
    // Where the width changes from end to end nothing is folded.
    if (floor == FloorMake::bent) options.bend.inner_radius = t;
    CHECK(plates_of(line, section::UChannel{whole, 0.2, t}, options).workshop.bends.empty());
  }
}

TEST_CASE(
    "widths: of a bent track's walls, what is rolled is judged by its radius, what is pressed by the punch") {
  PlateOptions options;
  options.bend.inner_radius = 9e-3;
  const WidthLaw widths(std::vector<WidthAt>{{2.0, 0.4}, {4.0, 0.6}});
  for (const section::Measures& measures :
       {section::Measures(section::UChannel{widths, 0.2, 3e-3}),
        section::Measures(section::Trapezoid{widths, 0.2, Angle::from_degrees(25.0), 3e-3})}) {
    INFO(section::kind(measures));
    const WorkshopBuild build = plates_of(chute(), measures, options);  // edges add up
    std::size_t pressed = 0;
    for (const ShopMeasurement& one : build.workshop.measured) {
      if (one.quantity == "rolling_radius_thicknesses") CHECK(one.value > 50e-3);
      if (one.quantity != "bend_radius_thicknesses") continue;
      CHECK(one.in_units() == Approx(3.0));
      ++pressed;
    }
    CHECK(pressed >= 4);
    for (const ShopPart* const wall : named(build, "wall")) {
      double before = 0.0;
      double sum = 0.0;
      for (const BendStep& step : build.workshop.bends) {
        if (step.part != wall->number) continue;
        CHECK(step.distance >= before);
        before = step.distance;
        sum += step.angle.radians();
        CHECK(step.sum.radians() == Approx(sum).margin(1e-12));
      }
    }
  }
}

TEST_CASE("widths: random tracks and widths make plates that fit and add up") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 12; ++run) {
    const ClothoidSpline track = testing::random_track(random, {.crest = -0.5, .valley = 0.8});
    const std::vector<WidthAt> knots = testing::random_widths(random, track.length());
    const double t = random.between(2e-3, 8e-3);
    PlateOptions options;
    options.split.longest = random.between(0.8, 3.0);
    options.walls = random.integer(0, 1) == 0 ? WallSeat::beside_floor : WallSeat::on_floor;
    options.flanges.wanted = random.integer(0, 2) > 0;
    for (const section::Measures& measures :
         {section::Measures(section::UChannel{WidthLaw(knots), random.between(0.1, 0.25), t}),
          section::Measures(section::Trapezoid{WidthLaw(knots), random.between(0.1, 0.25),
                                               Angle::from_degrees(random.between(2.0, 35.0)), t}),
          section::Measures(section::Slab{WidthLaw(knots), t})}) {
      INFO(section::kind(measures));
      const WorkshopBuild build =
          plates_of(track, measures, options);  // throws where parts clash or do not add up
      for (const ShopPart& part : build.workshop.parts) {
        CHECK(faults_of(part.pattern->region).empty());
        CHECK(part.mass > 0.0);
      }
    }
  }
}

TEST_CASE("widths: a wall that leans along the track weighs as much as the sheet that it is cut from") {
  const StraightLine line(Endpoints{4.0, 3.0});
  const section::UChannel channel{WidthLaw(std::vector<WidthAt>{{0.0, 1.4}, {5.0, 0.4}}), 0.25, 4e-3};
  PlateOptions options = in_one_piece();
  options.flanges.wanted = false;
  options.material.density = 7850.0;
  const WorkshopBuild build = plates_of(line, channel, options);
  // From 0.7 m to 0.2 m off the middle over 5 m: a rectangle, 4 mm thick whatever its body is.
  const double length = std::sqrt(5.0 * 5.0 + 0.5 * 0.5);
  for (const ShopPart* const wall : named(build, "wall")) {
    CHECK_THAT(wall->mass, Catch::Matchers::WithinRel(length * 0.254 * 4e-3 * 7850.0, 1e-9));
    CHECK_THAT(wall->volume, Catch::Matchers::WithinRel(5.0 * 0.254 * 4e-3, 1e-9));
  }
  CHECK_THAT(part_of(build, "floor").mass,
             Catch::Matchers::WithinRel(0.5 * (1.4 + 0.4) * 5.0 * 4e-3 * 7850.0, 1e-9));
}

TEST_CASE("widths: units get as short as the heaviest part asks, whatever the sheet asked for before") {
  PlateOptions options;
  options.split.heaviest = 16.0;
  const WidthLaw widths(std::vector<WidthAt>{{0.0, 1.8}, {1.3, 1.8}, {3.1, 1.5}});
  const WorkshopBuild build = plates_of(chute(), section::Slab{widths, 2e-3}, options);
  double heaviest = 0.0;
  for (const ShopPart* const floor : named(build, "floor")) heaviest = std::max(heaviest, floor->mass);
  CHECK(heaviest <= 16.0);
  CHECK(heaviest > 12.0);
}

TEST_CASE("widths: what cannot be made is refused with place, value and bound") {
  const auto refusal = [](const section::Measures& measures, const PlateOptions& options) {
    return refusal_of([&] { return plates_of(chute(), measures, options); });
  };
  const WidthLaw sudden({{2.0, 0.4}, {2.1, 0.8}});
  const std::string steep = refusal(section::UChannel{sudden, 0.25, 4e-3}, {});
  CHECK(steep.find("cross_section.width|the width changes by 4 m per metre at 2 m along the track") == 0);
  CHECK(steep.find("a longer stretch for the change") != std::string::npos);
  const WidthLaw far({{0.2, 0.3}, {7.5, 4.2}});
  CHECK(refusal(section::UChannel{far, 0.25, 4e-3}, {}).find("walls of plates would lean ") !=
        std::string::npos);
  PlateOptions lap;
  lap.corners.kind = CornerJoint::lap;
  CHECK(refusal(section::UChannel{kWidening, 0.25, 4e-3}, lap)
            .find("corners|corners: plates beside a width that changes") == 0);
  CHECK(
      refusal(section::Slab{kWidening, 6e-3, 0.05, 0.02}, {})
          .find("cross_section.width|fabrication: plates of curbs or a groove beside a width that changes") ==
      0);
}

TEST_CASE(
    "widths: tiles cover a floor that widens but for their gaps, those at the sides taking the change") {
  const StraightLine line(Endpoints{4.0, 3.0});
  const WidthLaw widths(std::vector<WidthAt>{{1.0, 0.5}, {4.0, 0.8}});
  PlateOptions options = in_one_piece();
  options.liner.emplace();
  options.liner->bolt = 6;
  const double radius = 3.3e-3;  // M6, medium
  for (const section::Measures& measures :
       {section::Measures(section::Slab{widths, 4e-3}),
        section::Measures(section::UChannel{widths, 0.2, 4e-3}),
        section::Measures(section::Trapezoid{widths, 0.2, Angle::from_degrees(20.0), 4e-3})}) {
    INFO(section::kind(measures));
    const WorkshopBuild build = plates_of(line, measures, options);
    double tiles = 0.0;
    double uncovered = 0.0;
    std::size_t holes = 0;
    for (const ShopPart* const tile : named(build, "tile_")) {
      tiles += static_cast<double>(tile->quantity()) * tile->volume / tile->thickness;
      holes += tile->quantity() * tile->pattern->region.holes.size();
      uncovered +=
          static_cast<double>(tile->quantity() * tile->pattern->region.holes.size()) * kPi * radius * radius;
      // Half a gap at its ends, and the one to its left.
      const auto& body = std::get<SweptBody>(tile->body);
      uncovered += static_cast<double>(tile->quantity()) * options.liner->gap * length(body.path);
      CHECK(moments(tile->pattern->region).area * tile->thickness == Approx(tile->volume).epsilon(1e-9));
    }
    // What is left are gaps between courses, and one more along each.
    double floor = 0.0;
    constexpr int kSlices = 50000;
    for (int k = 0; k < kSlices; ++k) floor += widths.at(5.0 * (k + 0.5) / kSlices) * 5.0 / kSlices;
    CHECK(tiles + uncovered < floor);
    CHECK(tiles + uncovered > 0.98 * floor);
    CHECK(build.proof.bolted == holes);
    CHECK(holes > 50);
    // Their holes are a listed difference of the floor.
    double listed = 0.0;
    for (const VolumeDifference& one : build.proof.differences) {
      if (one.what == "holes of the liner") listed += one.volume;
    }
    CHECK(-listed == Approx(static_cast<double>(holes) * kPi * 3.5e-3 * 3.5e-3 * 4e-3).epsilon(1e-9));
  }
}

TEST_CASE("widths: liners and covers beside a width that changes are closed bodies, bolted pair by pair") {
  const TempDir dir;
  PlateOptions options;
  options.liner.emplace();
  options.liner->bolt = 6;
  options.rim.emplace();
  options.cover.emplace();
  for (const section::Measures& measures :
       {section::Measures(section::UChannel{kWidening, 0.2, 4e-3}),
        section::Measures(section::Trapezoid{kWidening, 0.2, Angle::from_degrees(20.0), 4e-3})}) {
    INFO(section::kind(measures));
    // Sides that lean are the harder ones: upright ones in CI.
    if (std::holds_alternative<section::UChannel>(measures) && !testing::thorough()) continue;
    const WorkshopBuild build = plates_of(chute(), measures, options);  // throws where parts clash
    CHECK(build.proof.bolted > 50);
    std::size_t rims = 0;
    std::size_t covers = 0;
    for (const ShopPart& part : build.workshop.parts) {
      INFO(part.name);
      if (part.name.find("rim") != std::string::npos)
        rims += part.quantity() * part.pattern->region.holes.size();
      if (part.name.find("cover") != std::string::npos)
        covers += part.quantity() * part.pattern->region.holes.size();
      CHECK(faults_of(part.pattern->region).empty());
      const auto* const body = std::get_if<SweptBody>(&part.body);
      if (body == nullptr || body->holes.empty()) continue;
      CHECK(body->holes.size() == part.pattern->region.holes.size());
      const MeshFacts facts = measure(parts::facets_of(part.body, 2e-6));
      CHECK(facts.boundary_edges == 0);
      CHECK(facts.self_intersections == 0);
      CHECK(facts.volume == Approx(part.volume).epsilon(2e-4));
      write_step(dir.path() / "part.step", part);
      require_same_step(dir.path() / "part.step", part);
    }
    CHECK(rims == covers);
    CHECK(covers > 20);
  }
}

TEST_CASE("widths: openings are cut where the width does not change, lids lie on leaning sides") {
  const TempDir dir;
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int made = 0;
  const int runs = testing::thorough() ? 8 : 2;
  for (int run = 0; run < runs; ++run) {
    const double wide = random.between(0.3, 0.6);
    const double t = random.between(3e-3, 6e-3);
    const double from = random.between(1.5, 3.0);
    const WidthLaw widths({{from, wide}, {from + random.between(0.8, 2.0), random.between(0.8, 1.3) * wide}});
    PlateOptions options;
    options.inspection = {{random.between(3.0, 7.0), random.between(0.08, 0.2), 0.1, 6},
                          {random.between(0.6, 1.2), 0.1, random.between(0.06, 0.1), 6}};
    options.inspection.resize(static_cast<std::size_t>(random.integer(1, 2)));
    if (random.integer(0, 1) == 0) options.rim.emplace();
    if (random.integer(0, 1) == 0) options.stiffeners.emplace();
    if (random.integer(0, 2) == 0) options.liner.emplace();
    const section::Measures sections[] = {
        section::UChannel{widths, 0.25, t},
        section::Trapezoid{widths, 0.3, Angle::from_degrees(random.between(5.0, 40.0)), t}};
    const auto& measures = sections[random.integer(0, 1)];
    CAPTURE(run, measures.index(), from, options.inspection.front().at);
    WorkshopBuild build;
    const std::string text = refusal_of([&] { build = plates_of(chute(), measures, options); });
    if (!text.empty()) {
      INFO(text);
      CHECK(text.find("inspection|at: an opening at ") == 0);
      continue;
    }
    ++made;
    double opened = 0.0;
    std::size_t cut = 0;
    std::size_t bolts = 0;
    for (const ShopPart& part : build.workshop.parts) {
      INFO(part.name);
      CHECK(faults_of(part.pattern->region).empty());
      const auto* const body = std::get_if<SweptBody>(&part.body);
      if (body == nullptr) continue;
      if (part.name.starts_with("lid")) bolts += part.quantity() * body->holes.size();
      if (body->windows.empty()) continue;
      CHECK(part.name.starts_with("left_wall"));
      CHECK(part.quantity() == 1);
      cut += body->windows.size();
      REQUIRE(part.pattern->region.cutouts.size() == body->windows.size());
      CHECK(part.pattern->region.holes.size() == body->holes.size());
      for (const ArcPath& cutout : part.pattern->region.cutouts)
        opened += std::fabs(signed_area(cutout)) * part.thickness;
      const MeshFacts facts = measure(parts::facets_of(part.body, 2e-6));
      CHECK(facts.boundary_edges + facts.non_manifold_edges + facts.self_intersections == 0);
      CHECK(facts.volume == Approx(part.volume).epsilon(2e-4));
      for (const Vec3 point : parts::edge_points(part.body, 20e-6))
        CHECK(parts::depth_inside(part.body, point) > 0.0);
      write_step(dir.path() / "part.step", part);
      require_same_step(dir.path() / "part.step", part);
    }
    CHECK(cut == options.inspection.size());
    CHECK(bolts >= 4 * cut);
    CHECK(build.proof.bolted >= bolts);
    double listed = 0.0;
    for (const VolumeDifference& one : build.proof.differences) {
      if (one.what == "openings") listed += one.volume;
    }
    // Thickness counts across: square to a side that leans more than the section's it is less by a hair.
    CHECK(-listed == Approx(opened).epsilon(1e-2));
  }
  CHECK(made >= runs / 2);
}

TEST_CASE("widths: edges of walls that turn aside far in a bend are as long on the flat as they are made") {
  // Arcs of 5 deg had edges that differ by 1.1e-9 m here.
  const Friction friction = Friction::from_angle(Angle::from_degrees(11.9));
  const CoulombBrachistochrone track({4.508, 2.68}, friction);
  for (const double to : {1.903, 3.2}) {
    const WidthLaw widths({{0.0, 2.517}, {1.411, 2.517}, {3.11, to}});
    const WorkshopBuild build = make_plates(track, section::Measures(section::UChannel{widths, 0.455, 6e-3}),
                                            {1e-4}, {}, Placement(), {.friction = friction});
    CHECK(build.proof.edge_mismatch < 3e-10);
  }
}

TEST_CASE("widths: what is not made beside a width that changes is refused, and each way out builds") {
  const ClothoidSpline track(Angle::from_degrees(45.0), {{4.0, 0.2, 0.2}});
  const section::UChannel changing{WidthLaw({{1.0, 0.6}, {2.5, 0.8}}), 0.4, 4e-3};
  const section::UChannel one{WidthLaw(0.8), 0.4, 4e-3};
  struct Case {
    const char* where;
    const char* way_out;
    PlateOptions options;
    PlateOptions instead;
  };
  PlateOptions bent;
  bent.floor = FloorMake::bent;
  bent.bend = {FacetRule::segment_angle, 0.1, {}, {}};
  std::vector<Case> cases;
  const auto add = [&](const char* where, const char* way_out, PlateOptions options, PlateOptions instead) {
    cases.push_back({where, way_out, std::move(options), std::move(instead)});
  };
  for (const CornerJoint joint : {CornerJoint::lap, CornerJoint::tab_and_slot}) {
    for (const PlateOptions& plain : {PlateOptions(), bent}) {
      // Laps of bent floors and tabs of rolled ones, elsewhere than in CI.
      const bool laps = joint == CornerJoint::lap;
      if (!testing::thorough() && laps != (plain.floor == FloorMake::bent)) continue;
      PlateOptions with = plain;
      with.corners.kind = joint;
      add("corners", "corners: butt, or one width", with, plain);
    }
  }
  PlateOptions with = bent;
  with.inspection = {{3.4, 0.1, 0.1, 6}};
  PlateOptions rolled = with;
  rolled.floor = FloorMake::rolled;
  add("inspection", "floor: rolled, or one width", with, rolled);
  with = bent;
  with.rim.emplace();
  PlateOptions bare = with;
  with.cover.emplace();
  add("cover", "no cover, floor: rolled, or one width", with, bare);
  with = bent;
  with.liner.emplace();
  add("liner", "no liner, floor: rolled, or one width", with, bent);
  for (const Case& one_case : cases) {
    CAPTURE(one_case.where);
    const auto refused = [&](const section::Measures& measures, const PlateOptions& options) {
      return refusal_of([&] { return plates_of(track, measures, options); });
    };
    const std::string told = refused(changing, one_case.options);
    INFO(told);
    CHECK(told.find(std::string(one_case.where) + "|") == 0);
    CHECK(told.find(one_case.way_out) != std::string::npos);
    CHECK(refused(changing, one_case.instead) == "");
    CHECK(refused(one, one_case.options) == "");
    if (std::string(one_case.way_out).find("floor: rolled") == std::string::npos) continue;
    PlateOptions smooth = one_case.options;
    smooth.floor = FloorMake::rolled;
    CHECK(refused(changing, smooth) == "");
  }
  // An opening within the change is sent to where the width stays.
  PlateOptions opened;
  opened.inspection = {{1.7, 0.1, 0.1, 6}};
  const std::string told = refusal_of([&] { return plates_of(track, changing, opened); });
  REQUIRE(
      told.find("inspection|at: an opening at 1.7 m lies across a change of radius, where the width changes, "
                "or the end of a unit|") == 0);
  const double place = std::stod(told.substr(told.find("|at: ", 20) + 5));
  opened.inspection.front().at = place > 10.0 ? 1e-3 * place : place;  // [mm] of less than a metre
  CHECK(refusal_of([&] { return plates_of(track, changing, opened); }) == "");
}

}  // namespace widths_test
