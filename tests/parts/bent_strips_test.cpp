// Sections of any kind as flats between bends, beside one width or one that changes: plane facets, lengths, volumes, refusals.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_edges.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/temp_dir.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace bent_strips_test {

namespace {

using namespace glissade;
using namespace testing;

const WidthLaw kWidening({{2.0, 0.4}, {4.0, 0.6}, {6.0, 0.35}});

PlateOptions bent(double kink_deg = 1.6) {
  PlateOptions options;
  options.floor = FloorMake::bent;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(kink_deg).radians(), {}, {}};
  return options;
}

PlateOptions bent_in_one_piece() {
  PlateOptions options = bent();
  options.split.sheet = {20.0, 8.0};
  return options;
}

/// How far four points lie off the plane through the first three of them.
double off_plane(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Vec3 normal = cross(b - a, c - a);
  return std::fabs(dot(d - a, normal)) / norm(normal);
}

Vec3 middle(const std::array<Vec3, 4>& ring, std::size_t one, std::size_t other) {
  return 0.5 * (ring[one] + ring[other]);
}

double whole_length(const ShopPart& part) {
  return bounds(part.pattern->region.outline).width();
}

}  // namespace

TEST_CASE(
    "bent strips: every facet is six planes, of walls beside a width that changes, of trapezoids and "
    "staves") {
  PlateOptions staves = bent();
  staves.round = RoundMake::staves;
  for (const section::Measures& measures :
       {section::Measures(section::UChannel{kWidening, 0.25, 4e-3}),
        section::Measures(section::Trapezoid{kWidening, 0.2, Angle::from_degrees(20.0), 4e-3}),
        section::Measures(section::Trapezoid{WidthLaw(0.4), 0.2, Angle::from_degrees(20.0), 4e-3}),
        section::Measures(section::HalfPipe{0.4, 0.05, 4e-3}),
        section::Measures(section::Slab{kWidening, 6e-3})}) {
    const WorkshopBuild build = plates_of(chute(), measures, staves);
    std::size_t facets = 0;
    for (const ShopPart& part : build.workshop.parts) {
      const auto* const body = std::get_if<FoldedPlate>(&part.body);
      if (body == nullptr) continue;
      for (std::size_t i = 0; i + 1 < body->corners.size(); ++i, ++facets) {
        const auto& from = body->corners[i];
        const auto& to = body->corners[i + 1];
        CHECK(off_plane(from[0], from[1], from[2], from[3]) < 1e-12);
        for (std::size_t j = 0; j < 4; ++j)
          CHECK(off_plane(from[j], from[(j + 1) % 4], to[j], to[(j + 1) % 4]) < 1e-12);
      }
    }
    CHECK(facets > 40);
    CHECK(build.proof.edge_mismatch < 1e-9);
    CHECK(build.proof.differences.size() == 1);
    CHECK(std::fabs(build.proof.differences.front().volume) < 2e-3 * build.proof.exact_volume);
    CHECK(build.ride.arrives);
    CHECK(build.ride.bends > 40);
  }
}

TEST_CASE("bent strips: a wall that takes its form by itself is, laid flat facet by facet, its pattern") {
  PlateOptions options = bent_in_one_piece();
  // Folds about a neutral fibre in the middle, as sharp as they may be, take next to nothing of the flat.
  options.bend.inner_radius = 4e-3;
  options.bend.k_factor = 0.5;
  const WorkshopBuild build = plates_of(chute(), section::UChannel{kWidening, 0.18, 4e-3}, options);
  for (const char* const name : {"left_wall", "right_wall"}) {
    const ShopPart& wall = part_of(build, name);
    const auto& rings = std::get<FoldedPlate>(wall.body).corners;
    const std::vector<PathVertex>& corners = wall.pattern->region.outline.vertices;
    REQUIRE(corners.size() == 2 * rings.size());
    // Ring corners: face_from, face_to, back_to, back_from, or the other way round; pattern: the middle of the thickness.
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
      const std::array<Vec3, 4> quad = {middle(rings[i], 1, 2), middle(rings[i + 1], 1, 2),
                                        middle(rings[i + 1], 0, 3), middle(rings[i], 0, 3)};
      const std::array<std::size_t, 4> one = {i, i + 1, corners.size() - 2 - i, corners.size() - 1 - i};
      const std::array<std::size_t, 4> other = {one[3], one[2], one[1], one[0]};
      double as_one = 0.0;
      double as_other = 0.0;
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = 0; b < a; ++b) {
          const double there = norm(quad[a] - quad[b]);
          as_one = std::max(as_one, std::fabs(norm(corners[one[a]].at - corners[one[b]].at) - there));
          as_other = std::max(as_other, std::fabs(norm(corners[other[a]].at - corners[other[b]].at) - there));
        }
      }
      worst = std::max(worst, std::min(as_one, as_other));
    }
    double taken = 0.0;
    for (const BendLine& bend : wall.pattern->bends) {
      const double half = 0.5 * bend.angle.radians();
      taken += 2.0 * (4e-3 + 2e-3) * (std::tan(half) - half);
    }
    CHECK(taken < 1e-5);
    CHECK(worst < 1e-9 + taken);
    // Folded where the width begins, turns and ceases to change; bends of the floor turn it by a tenth of a degree.
    CHECK(wall.pattern->bends.size() <= 3);
    CHECK(wall.pattern->bends.size() >= 2);
  }
}

TEST_CASE("bent strips: folds of walls beside a width that changes take of the flat what the punch does") {
  const double t = 4e-3;
  PlateOptions options = bent_in_one_piece();
  for (const double radius : {t, 10e-3, 40e-3}) {
    CAPTURE(radius);
    options.bend.inner_radius = radius;
    const WorkshopBuild build = plates_of(chute(), section::UChannel{kWidening, 0.18, t}, options);
    for (const char* const name : {"left_wall", "right_wall"}) {
      const ShopPart& wall = part_of(build, name);
      const auto& rings = std::get<FoldedPlate>(wall.body).corners;
      const std::vector<PathVertex>& corners = wall.pattern->region.outline.vertices;
      REQUIRE(corners.size() == 2 * rings.size());
      // Both edges in the middle of the thickness, sharp, less (r + K t) a for 2 (r + t/2) tan(a/2) at each fold, along them: they
      // meet the fold all but square.
      double sharp = 0.0;
      double flat = 0.0;
      for (std::size_t i = 0; i + 1 < rings.size(); ++i) {
        sharp += norm(middle(rings[i + 1], 1, 2) - middle(rings[i], 1, 2)) +
                 norm(middle(rings[i + 1], 0, 3) - middle(rings[i], 0, 3));
        flat += norm(corners[i + 1].at - corners[i].at) +
                norm(corners[corners.size() - 1 - i].at - corners[corners.size() - 2 - i].at);
      }
      double taken = 0.0;
      for (const BendLine& bend : wall.pattern->bends) {
        const double angle = bend.angle.radians();
        taken += 2.0 * (2.0 * (radius + 0.5 * t) * std::tan(0.5 * angle) -
                        (radius + k_factor(radius, t) * t) * angle);
      }
      REQUIRE(wall.pattern->bends.size() >= 2);
      CHECK(taken > 0.0);
      CHECK(sharp - flat == Approx(taken).epsilon(0.01));
    }
    CHECK(build.proof.edge_mismatch < 1e-9);
  }
}

TEST_CASE("bent strips: gentle bends of leaning sides are pressed, upright ones that spring are told") {
  // Radii of 20 m and more: 5,000 thicknesses.
  const ClothoidSpline gentle(Angle::from_degrees(40.0), {{4.0, 0.05, 0.05}});
  PlateOptions options = bent(1.0);
  const WorkshopBuild build =
      plates_of(gentle, section::Trapezoid{WidthLaw(0.4), 0.2, Angle::from_degrees(45.0), 4e-3}, options);
  std::size_t bends = 0;
  for (const ShopPart& part : build.workshop.parts) {
    const auto* const body = std::get_if<FoldedPlate>(&part.body);
    if (body == nullptr) continue;
    CHECK(part.pattern->bends.size() == body->corners.size() - 2);
    if (part.name.starts_with("floor")) bends += part.quantity() * part.pattern->bends.size();
  }
  CHECK(bends == build.ride.bends);
  CHECK(bends > 0);
  const auto told = [](const WorkshopBuild& made) {
    return std::any_of(made.workshop.notes.begin(), made.workshop.notes.end(), [](const std::string& note) {
      return note.find("sprung into place") != std::string::npos;
    });
  };
  CHECK_FALSE(told(build));
  CHECK(told(plates_of(chute(), section::UChannel{kWidening, 0.18, 4e-3}, bent())));
}

TEST_CASE("bend schedules of mirror images count along the edge beside the floor, both alike") {
  for (const FloorMake floor : {FloorMake::bent, FloorMake::rolled}) {
    PlateOptions options = bent();
    options.floor = floor;
    const WorkshopBuild build =
        plates_of(chute(), section::Trapezoid{WidthLaw(0.4), 0.2, Angle::from_degrees(40.0), 4e-3}, options);
    const auto rows_of = [&](const std::string& name) {
      std::vector<BendStep> rows;
      for (const BendStep& step : build.workshop.bends) {
        if (step.part == part_of(build, name).number) rows.push_back(step);
      }
      return rows;
    };
    const std::vector<BendStep> left = rows_of("left_wall");
    const std::vector<BendStep> right = rows_of("right_wall");
    REQUIRE(left.size() == right.size());
    REQUIRE(left.size() > 2);
    // They count along the line in which they meet the floor; bends of less angle take less of it.
    const std::vector<BendStep> below = rows_of("floor");
    REQUIRE(below.size() == left.size());
    const double takes = floor == FloorMake::bent ? 1e-3 : 1e-9;
    for (std::size_t i = 0; i < left.size(); ++i) {
      CHECK(std::fabs(left[i].distance - right[i].distance) < 1e-9);
      CHECK(std::fabs(left[i].length - right[i].length) < 1e-9);
      CHECK(std::fabs(left[i].distance - below[i].distance) < takes);
    }
  }
}

TEST_CASE("bent strips: the pattern of a floor that widens to both sides is the same on both") {
  std::size_t bends = 0;
  for (const section::Measures& measures :
       {section::Measures(section::Slab{kWidening, 4e-3}),
        section::Measures(section::UChannel{kWidening, 0.18, 4e-3}),
        section::Measures(section::Trapezoid{kWidening, 0.18, Angle::from_degrees(20.0), 4e-3})}) {
    INFO(section::kind(measures));
    const WorkshopBuild build = plates_of(chute(), measures, bent_in_one_piece());
    for (const ShopPart* const floor : named(build, "floor")) {
      const std::vector<BendLine>& lines = floor->pattern->bends;
      REQUIRE(lines.size() > 10);
      const auto middle_of = [](const BendLine& line) { return 0.5 * (line.from + line.to); };
      const Vec2 axis = middle_of(lines.back()) - middle_of(lines.front());
      for (const BendLine& line : lines) {
        ++bends;
        // Square to the axis, and as far on both sides of it.
        CHECK(dot(line.to - line.from, axis) == Approx(0.0).margin(1e-9));
        CHECK(cross(middle_of(line) - middle_of(lines.front()), axis) == Approx(0.0).margin(1e-9));
      }
    }
  }
  CHECK(bends > 30);
}

TEST_CASE("bent strips: beside a width that is one everywhere the floor is the bent floor of a channel") {
  const WidthLaw same({{1.0, 0.4}, {3.0, 0.4 + 1e-9}});
  PlateOptions options = bent_in_one_piece();
  options.bend.inner_radius = 8e-3;
  const WorkshopBuild strips = plates_of(chute(), section::UChannel{same, 0.18, 4e-3}, options);
  const WorkshopBuild channel = plates(chute(), options, {0.4, 0.18, 4e-3});
  const ShopPart& floor = part_of(strips, "floor");
  const ShopPart& other = part_of(channel, "floor");
  CHECK(std::fabs(whole_length(floor) - whole_length(other)) < 1e-9);
  REQUIRE(floor.pattern->bends.size() == other.pattern->bends.size());
  for (std::size_t i = 0; i < floor.pattern->bends.size(); ++i) {
    const BendLine& one = floor.pattern->bends[i];
    const BendLine& there = other.pattern->bends[i];
    CHECK(std::fabs(one.from.x - there.from.x) < 1e-9);
    CHECK(std::fabs(one.angle.radians() - there.angle.radians()) < 1e-9);
    CHECK(one.up == there.up);
    CHECK(one.inner_radius == 8e-3);
  }
  CHECK(std::fabs(strips.ride.exit_speed - channel.ride.exit_speed) < 1e-12);
  // Bends without a radius hold what their corners have beyond those of the punch.
  CHECK(std::fabs(floor.volume / other.volume - 1.0) < 1e-6);
}

TEST_CASE(
    "bent strips: a wall that leans is pressed at each bend of the floor, by what its lean leaves of the "
    "angle") {
  const section::Trapezoid measures{WidthLaw(0.4), 0.2, Angle::from_degrees(30.0), 4e-3};
  const WorkshopBuild build = plates_of(chute(), measures, bent_in_one_piece());
  const ShopPart& floor = part_of(build, "floor");
  const ShopPart& wall = part_of(build, "left_wall");
  REQUIRE(wall.pattern->bends.size() == floor.pattern->bends.size());
  for (std::size_t i = 0; i < wall.pattern->bends.size(); ++i) {
    // Two planes that lean by b, turned by phi about a level line across: sin(theta/2) = sin(phi/2) sin b.
    const double phi = floor.pattern->bends[i].angle.radians();
    const double theta = 2.0 * std::asin(std::sin(0.5 * phi) * std::sin(Angle::from_degrees(30.0).radians()));
    CHECK(std::fabs(wall.pattern->bends[i].angle.radians() - theta) < 1e-9);
    CHECK(wall.pattern->bends[i].up == floor.pattern->bends[i].up);
  }
  CHECK(std::count_if(build.workshop.bends.begin(), build.workshop.bends.end(), [&](const BendStep& step) {
          return step.part == wall.number;
        }) == static_cast<std::ptrdiff_t>(wall.pattern->bends.size()));
}

TEST_CASE(
    "bent strips: bodies are closed, outward and of their volume, in facets and in STEP, of planes alone") {
  const TempDir dir;
  PlateOptions options = bent();
  options.rim.emplace();  // ends square beside frames
  const WorkshopBuild build = plates_of(chute(), section::UChannel{kWidening, 0.25, 4e-3}, options);
  for (const ShopPart& part : build.workshop.parts) {
    write_step(dir.path() / "part.step", part);
    require_same_step(dir.path() / "part.step", part);
    if (!std::holds_alternative<FoldedPlate>(part.body)) continue;
    CHECK(read_step_facts(dir.path() / "part.step").solids.front().splines == 0);
    const MeshFacts facts = measure(parts::facets_of(part.body, 1e-5));
    CHECK(facts.volume == Approx(part.volume).epsilon(1e-12));
    for (const Vec3 point : parts::edge_points(part.body, 1e-4)) {
      CHECK(parts::depth_inside(part.body, point) > 0.5e-4);
      CHECK(parts::depth_inside(part.body, point + Vec3{0.0, 0.0, 20.0}) < -1.0);
    }
  }
}

TEST_CASE(
    "bent strips: rims meet the outsides of their walls' tops at every bend, and end before the frames") {
  PlateOptions options = bent();
  options.rim.emplace();
  options.round = RoundMake::staves;
  options.stave_tolerance = 10e-3;
  const WidthLaw widths(std::vector<WidthAt>{{1.0, 0.4}, {4.0, 0.5}});
  for (const section::Measures& measures :
       {section::Measures(section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(25.0), 4e-3}),
        section::Measures(section::UChannel{widths, 0.2, 4e-3}),
        section::Measures(section::HalfPipe{0.4, 0.1, 4e-3})}) {
    INFO(section::kind(measures));
    const WorkshopBuild build = plates_of(chute(), measures, options);  // throws where parts clash
    std::vector<Vec3> corners;
    for (const ShopPart& part : build.workshop.parts) {
      const auto* const plate = std::get_if<FoldedPlate>(&part.body);
      if (plate == nullptr || part.name.find("rim") != std::string::npos) continue;
      for (const Frame& place : part.places) {
        for (const auto& ring : plate->corners) {
          for (const Vec3 corner : ring) corners.push_back(place.to_space(corner));
        }
      }
    }
    std::size_t bends = 0;
    const auto rims = named(build, "rim");
    REQUIRE(rims.size() >= 2);
    for (const ShopPart* const rim : rims) {
      const auto& plate = std::get<FoldedPlate>(rim->body);
      CHECK(faults_of(rim->pattern->region).empty());
      CHECK(rim->thickness == 5e-3);
      for (std::size_t i = 0; i < plate.corners.size(); ++i) {
        double least = 1e300;
        for (const Vec3 own : plate.corners[i]) {
          for (const Vec3 other : corners)
            least = std::min(least, norm(rim->places.front().to_space(own) - other));
        }
        // Beside frames it ends between bends.
        if (i == 0 || i + 1 == plate.corners.size()) continue;
        ++bends;
        CHECK(least < 1e-6);
      }
      // A level bar develops to its flats, each bend a little less than its corner.
      double flats = 0.0;
      for (std::size_t i = 0; i + 1 < plate.corners.size(); ++i)
        flats += norm(middle(plate.corners[i + 1], 0, 2) - middle(plate.corners[i], 0, 2));
      CHECK(whole_length(*rim) == Approx(flats).epsilon(0.02));
    }
    CHECK(bends > 20);
  }
}

TEST_CASE("bent strips: random tracks, widths and rules make plates that fit, add up and clear one another") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 10; ++run) {
    const ClothoidSpline track = testing::random_track(random, {.crest = -0.5, .valley = 0.8});
    const std::vector<WidthAt> knots = testing::random_widths(random, track.length());
    const double t = random.between(2e-3, 6e-3);
    PlateOptions options = bent(random.between(1.0, 6.0));
    if (run % 3 == 1) options.bend = {FacetRule::chord_tolerance, 1e-3, {}, {}};
    // No tighter than rims are thick.
    if (run % 3 == 2) options.bend = {FacetRule::bends, 9.0, std::max(2.0 * t, RimOptions{}.thickness), {}};
    options.split.longest = random.between(0.8, 3.0);
    options.walls = random.integer(0, 1) == 0 ? WallSeat::beside_floor : WallSeat::on_floor;
    options.round = RoundMake::staves;
    for (const section::Measures& measures :
         {section::Measures(section::UChannel{WidthLaw(knots), random.between(0.1, 0.25), t}),
          section::Measures(section::Trapezoid{WidthLaw(knots), random.between(0.1, 0.25),
                                               Angle::from_degrees(random.between(2.0, 35.0)), t}),
          section::Measures(section::Slab{WidthLaw(knots), t}),
          section::Measures(section::Pipe{random.between(0.1, 0.3), t}),
          section::Measures(section::VChannel{Angle::from_degrees(80.0), 0.05, 0.2, t})}) {
      INFO(section::kind(measures));
      const bool walls = std::holds_alternative<section::UChannel>(measures) ||
                         std::holds_alternative<section::Trapezoid>(measures);
      options.rim = walls && run % 2 == 0 ? std::optional(RimOptions{}) : std::nullopt;
      const WorkshopBuild build =
          plates_of(track, measures, options);  // throws where parts clash or do not add up
      for (const ShopPart& part : build.workshop.parts) {
        CHECK(faults_of(part.pattern->region).empty());
        CHECK(part.mass > 0.0);
      }
    }
  }
}

TEST_CASE(
    "bent strips: walls higher than the flats of a hollow allow, and punches too sharp, are refused with "
    "what would do") {
  const ClothoidSpline hollow(Angle::from_degrees(60.0),
                              {{1.0, 0.0, 0.0}, {0.2, 1.0 / 0.3, 1.0 / 0.3}, {1.0, 0.0, 0.0}});
  const section::Trapezoid high{WidthLaw(0.4), 0.4, Angle::from_degrees(20.0), 4e-3};
  const std::string fold = refusal_of([&] { return plates_of(hollow, high, bent()); });
  CHECK(fold.find("cross_section|the left_wall folds over at ") == 0);
  CHECK(fold.find("high above the floor line, a flat there ") != std::string::npos);
  CHECK(fold.find("a section of at most 29") != std::string::npos);
  PlateOptions punch = bent();
  punch.bend.inner_radius = 1e-3;
  CHECK(
      refusal_of([&] {
        return plates_of(chute(), high, punch);
      }).find("bend.inner_radius|inner_radius: 1 mm is less than the plate's thickness|Mild steel cracks") ==
      0);
}

TEST_CASE(
    "bent strips: a punch too sharp for several plates is told of the thickest, and its radius does for "
    "all") {
  for (const section::Measures& measures : std::vector<section::Measures>{
           section::Trapezoid{WidthLaw(0.4), 0.25, Angle::from_degrees(20.0), 4e-3},
           section::UChannel{WidthLaw(0.4), 0.25, 4e-3}}) {
    PlateOptions options = bent();
    options.rim.emplace();
    options.rim->thickness = 5e-3;
    options.liner.emplace();
    options.liner->thickness = 6e-3;
    const auto radius_problem = [&](double radius) -> std::string {
      options.bend.inner_radius = radius;
      for (const Issue& issue : plate_problems(measures, options)) {
        if (issue.where == "bend.inner_radius") return issue.what + "|" + issue.why + "|" + issue.hint;
      }
      return "";
    };
    for (const double sharp : {1e-3, 4.5e-3, 5.5e-3})
      CHECK(radius_problem(sharp) ==
            "inner_radius: " + length_text(sharp) +
                " is less than the liner's thickness|Mild steel cracks below 6 mm (1 "
                "thickness).|inner_radius: 6 mm");
    CHECK(radius_problem(6e-3).empty());
  }
}

}  // namespace bent_strips_test
