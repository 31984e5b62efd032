// Bent plates of sections other than channels with laps, tabs and slots, covers, liners and openings: bodies, patterns, proof.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/math.hpp"
#include "glissade/io/step_file.hpp"
#include "glissade/parts/bend_hits.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_depth.hpp"
#include "parts/bodies/body_edges.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "parts/bodies/bores.hpp"
#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/curves/nearest_place.hpp"
#include "parts/random_tracks.hpp"
#include "parts/refusals.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shortfalls.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace bent_works_test {

namespace {

using namespace glissade;
using namespace testing;

PlateOptions bent(CornerJoint corners) {
  PlateOptions options;
  options.floor = FloorMake::bent;
  options.bend = {FacetRule::segment_angle, Angle::from_degrees(2.5).radians(), {}, {}};
  options.corners.kind = corners;
  return options;
}

PlateOptions with_everything(CornerJoint corners) {
  PlateOptions options = bent(corners);
  options.rim.emplace();
  options.cover.emplace();
  options.liner.emplace();
  options.liner->bolt = 6;
  options.inspection = {{2.5, 0.5, 0.1, 8}};
  return options;
}

section::Trapezoid trapezoid() {
  return {WidthLaw(0.4), 0.25, Angle::from_degrees(25.0), 4e-3};
}

double listed(const WorkshopBuild& build, const std::string& what) {
  double sum = 0.0;
  for (const VolumeDifference& one : build.proof.differences) {
    if (one.what == what) sum += one.volume;
  }
  return sum;
}

/// On which flat of a sheet a place along its path lies.
std::size_t flat_of(const RolledSheet& sheet, double x) {
  std::size_t flat = 0;
  for (const PathPiece& piece : pieces_of(sheet.path)) {
    if (x <= length(piece)) break;
    x -= length(piece);
    ++flat;
  }
  return flat;
}

/// Holes of one flat are as far from one another on the pattern as they are on the body.
std::size_t require_pattern_of_holes(const ShopPart& part) {
  const auto* const sheet = std::get_if<RolledSheet>(&part.body);
  if (sheet == nullptr) return 0;
  const std::vector<Circle>& flat = part.pattern->region.holes;
  const std::vector<Circle>& own = sheet->region.holes;
  const std::vector<parts::Bore> bores = parts::bores_of(*sheet);
  REQUIRE(flat.size() == bores.size());
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < bores.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const std::size_t flat_piece = flat_of(*sheet, own[i].centre.x);
      // Rims and covers of upright walls are rolled.
      if (flat_piece != flat_of(*sheet, own[k].centre.x) || !pieces_of(sheet->path)[flat_piece].straight())
        continue;
      ++pairs;
      const double apart = norm(bores[i].centre - bores[k].centre);
      CHECK(norm(flat[i].centre - flat[k].centre) == Approx(apart).margin(1e-10));
    }
  }
  return pairs;
}

/// Straight, a hollow and straight.
ClothoidSpline straights() {
  return {Angle::from_degrees(60.0), {{1.4, 0.0}, {2.1, 1.0 / 6.0}, {1.5, 0.0}}};
}

/// From where to where along the track a part reaches, over its highest corners or its lowest.
parts::Span reach_of(const ShopPart& part, const ArcSpline& track) {
  parts::Span reach{track.length(), 0.0};
  const Frame& place = part.places.front();
  for (const Vec3 vertex : parts::facets_of(part.body, 1e-4).vertices) {
    const Vec3 at = place.to_space(vertex);
    const double s = parts::nearest_place(track, {0.0, track.length()}, {at.x, at.z}).s;
    reach = {std::min(reach.from, s), std::max(reach.to, s)};
  }
  return reach;
}

}  // namespace

TEST_CASE(
    "bent works: openings are where they are asked for, or where their note says, along straights and "
    "bends") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  PlateOptions options = bent(CornerJoint::butt);
  int told = 0;
  int kept = 0;
  for (const double fixed : {0.35, 0.55, 1.0, 2.4, 4.2, 4.6, 0.0, 0.0}) {
    const double asked = fixed > 0.0 ? fixed : random.between(0.3, 4.6);
    INFO("asked " << asked);
    options.inspection = {{asked, 0.2, 0.1, 8}};
    const WorkshopBuild build = plates_of(straights(), trapezoid(), options);
    const parts::Span lid = reach_of(*named(build, "lid").front(), *build.master.spline);
    const double at = 0.5 * (lid.from + lid.to);
    const std::string note = shortfall_of(build.workshop, "at: the opening that is asked for at ");
    // Of a lid across bends the middle of its corners is some millimetres off that of its face.
    constexpr double kMiddle = 6e-3;
    CHECK(std::fabs(at - asked) < 0.1 + 40e-3 + kMiddle);
    if (note.empty()) {
      CHECK(std::fabs(at - asked) < kMiddle);
      ++kept;
      continue;
    }
    const std::size_t place = note.find(" along the track is at ") + 23;
    std::size_t digits = 0;
    double said = std::stod(note.substr(place), &digits);
    if (note.substr(place + digits, 3) == " mm") said *= 1e-3;
    CHECK(std::fabs(at - said) < kMiddle);
    ++told;
  }
  CHECK(kept > 2);
}

TEST_CASE("bent works: tiles that wear lie where the floor does, and their note says where they lie") {
  PlateOptions options = bent(CornerJoint::butt);
  options.liner.emplace();
  options.liner->bolt = 8;
  options.liner->material.name = "400 HB";
  options.liner->tile_length = 0.3;
  options.liner->where = LinerPlaces::worn;
  options.liner->worn_from = 0.75;
  for (const double peak : {0.7, 2.3, 4.3}) {
    INFO("peak " << peak);
    // 75 % of it within 0.25 m.
    options.floor_wear = {{0.0, 0.1, 1e-10},
                          {peak - 0.5, 0.5, 2e-9},
                          {peak, 1.0, 4e-9},
                          {peak + 0.5, 0.5, 2e-9},
                          {5.0, 0.1, 1e-10}};
    const WorkshopBuild build = plates_of(straights(), trapezoid(), options);
    parts::Span wears{5.0, 0.0};
    for (const ShopPart* const part : named(build, "tile_")) {
      for (std::size_t i = 0; i < part->places.size(); ++i) {
        ShopPart one = *part;
        one.places = {part->places[i]};
        const parts::Span tile = reach_of(one, *build.master.spline);
        const bool plain = part->name.find("plain_") == 0;
        // As far as their edges lie off the track's own.
        constexpr double kEdge = 2e-3;
        if (tile.to > peak - 0.25 + kEdge && tile.from < peak + 0.25 - kEdge) CHECK_FALSE(plain);
        if (tile.to < peak - 0.25 - kEdge || tile.from > peak + 0.25 + kEdge) CHECK(plain);
        if (!plain) wears = {std::min(wears.from, tile.from), std::max(wears.to, tile.to)};
      }
    }
    CHECK(wears.from < peak);
    CHECK(wears.to > peak);
    const auto note =
        std::find_if(build.workshop.notes.begin(), build.workshop.notes.end(),
                     [](const std::string& one) { return one.rfind("Tiles of 400 HB lie where", 0) == 0; });
    REQUIRE(note != build.workshop.notes.end());
    const std::size_t place = note->find("or more, ") + 9;
    std::size_t digits = 0;
    double from = std::stod(note->substr(place), &digits);
    if (note->substr(place + digits, 3) == " mm") from *= 1e-3;
    CHECK(std::fabs(from - wears.from) < 6e-3);
  }
}

TEST_CASE("bent works: a width that changes on a straight changes where it is asked for") {
  section::UChannel channel{WidthLaw({{0.3, 0.4}, {0.8, 0.5}}), 0.25, 4e-3};
  const WorkshopBuild build = plates_of(straights(), channel, bent(CornerJoint::butt));
  std::vector<double> folds;
  for (const ShopPart* const part : named(build, "left_wall")) {
    const auto& body = std::get<FoldedPlate>(part->body);
    for (const auto& corners : body.corners) {
      const Vec3 at = part->places.front().to_space(corners[0]);
      folds.push_back(parts::nearest_place(*build.master.spline, {0.0, 5.0}, {at.x, at.z}).s);
    }
  }
  for (const double knot : {0.3, 0.8}) {
    CHECK(std::any_of(folds.begin(), folds.end(), [&](double s) { return std::fabs(s - knot) < 1e-6; }));
  }
}

TEST_CASE("bent works: laps, tabs, slots, holes and openings are those of body, pattern, facets and STEP") {
  const TempDir dir;
  std::size_t pairs = 0;
  std::size_t parted = 0;
  for (const CornerJoint corners : {CornerJoint::lap, CornerJoint::tab_and_slot}) {
    // Tabs and slots have all that laps have, and more: laps in CI.
    if (corners == CornerJoint::lap && !testing::thorough()) continue;
    const WorkshopBuild build = plates_of(chute(), trapezoid(), with_everything(corners));
    CHECK(build.proof.bolted > 100);
    CHECK(build.proof.edge_mismatch < 1e-9);
    CHECK(listed(build, "openings") < 0.0);
    CHECK(listed(build, "holes of the liner") < 0.0);
    CHECK(listed(build, "holes of lids") < 0.0);
    CHECK((corners == CornerJoint::lap) == (listed(build, "tabs") == 0.0));
    CHECK((corners == CornerJoint::lap) == (listed(build, "slots") == 0.0));
    for (const ShopPart& part : build.workshop.parts) {
      INFO(part.name);
      CHECK(faults_of(part.pattern->region).empty());
      const auto* const sheet = std::get_if<RolledSheet>(&part.body);
      if (sheet == nullptr) continue;
      pairs += require_pattern_of_holes(part);
      const MeshFacts facts = measure(parts::facets_of(part.body, testing::thorough() ? 2e-7 : 5e-7));
      CHECK(facts.boundary_edges == 0);
      CHECK(facts.self_intersections == 0);
      CHECK(facts.oriented_outward);
      CHECK(facts.volume == Approx(part.volume).epsilon(2e-6));  // chords of holes
      for (const Vec3 point : parts::edge_points(part.body, 1e-4))
        CHECK(parts::depth_inside(part.body, point) > 0.5e-4);
      write_step(dir.path() / "part.step", part);
      require_same_step(dir.path() / "part.step", part);
      CHECK(read_step_facts(dir.path() / "part.step").solids.front().splines == 0);
      // Bends that an opening parts have two lines.
      for (std::size_t i = 0; i + 1 < part.pattern->bends.size(); ++i) {
        const BendLine& one = part.pattern->bends[i];
        const BendLine& other = part.pattern->bends[i + 1];
        if (std::fabs(cross(one.to - one.from, other.from - one.from)) < 1e-12 * norm(one.to - one.from))
          ++parted;
      }
    }
  }
  CHECK(pairs > 100);
  CHECK(parted > 0);
}

TEST_CASE("bent works: a plate with nothing but its edges lapped is the mitred one and its lap") {
  const WorkshopBuild plain = plates_of(chute(), trapezoid(), bent(CornerJoint::butt));
  const WorkshopBuild lapped = plates_of(chute(), trapezoid(), bent(CornerJoint::lap));
  CHECK(lapped.proof.volume == Approx(plain.proof.volume + listed(lapped, "laps") +
                                      listed(lapped, "edges beyond the ends of other plates"))
                                   .epsilon(1e-11));
  CHECK(lapped.ride.exit_speed == plain.ride.exit_speed);
  CHECK(lapped.ride.travel_time == plain.ride.travel_time);
  // What is not lapped stays what it is: bends and their rows. Walls of a unit whose flats are alike from both ends are one part.
  const auto bends_of = [](const WorkshopBuild& build) {
    std::size_t pressed = 0;
    std::size_t rows = 0;
    for (const ShopPart& part : build.workshop.parts) {
      if (!part.pattern || part.pattern->bends.empty()) continue;
      pressed += part.quantity() * part.pattern->bends.size();
      rows += part.pattern->bends.size();
    }
    CHECK(rows == build.workshop.bends.size());
    return pressed;
  };
  CHECK(bends_of(lapped) == bends_of(plain));
  for (const ShopPart* const floor : named(plain, "floor")) {
    const auto other = named(lapped, floor->name);
    REQUIRE(other.size() == 1);
    REQUIRE(floor->pattern->bends.size() == other.front()->pattern->bends.size());
    for (std::size_t i = 0; i < floor->pattern->bends.size(); ++i) {
      CHECK(floor->pattern->bends[i].angle.radians() ==
            Approx(other.front()->pattern->bends[i].angle.radians()).epsilon(1e-9));
      CHECK(floor->pattern->bends[i].up == other.front()->pattern->bends[i].up);
    }
  }
}

TEST_CASE("bent works: walls of a channel with a liner, or on the floor, follow its flats") {
  const section::UChannel channel{WidthLaw(0.4), 0.25, 4e-3};
  PlateOptions options = bent(CornerJoint::butt);
  options.walls = WallSeat::on_floor;
  const WorkshopBuild seated = plates_of(chute(), channel, options);
  for (const ShopPart* const floor : named(seated, "floor"))
    CHECK(bounds(floor->pattern->region.outline).height() == Approx(0.408).epsilon(1e-12));
  options.liner.emplace();
  const WorkshopBuild lined = plates_of(chute(), channel, options);
  CHECK(lined.proof.bolted > 100);
  CHECK(!named(lined, "tile").empty());
  std::size_t bends = 0;
  for (const ShopPart* const tile : named(lined, "tile")) bends += tile->pattern->bends.size();
  CHECK(bends > 10);
  // Butted or mitred, upright walls add up to one section.
  const section::Trapezoid upright{WidthLaw(0.4), 0.25, Angle(), 4e-3};
  const WorkshopBuild mitred = plates_of(chute(), upright, options);
  CHECK(lined.proof.volume == Approx(mitred.proof.volume).epsilon(1e-12));
  CHECK(lined.ride.exit_speed == mitred.ride.exit_speed);
  // Laps and tabs go round the same corners.
  options.walls = WallSeat::beside_floor;
  options.corners.kind = CornerJoint::tab_and_slot;
  const WorkshopBuild tabbed = plates_of(chute(), channel, options);
  CHECK(listed(tabbed, "tabs") > 0.0);
  CHECK(tabbed.proof.volume == plates_of(chute(), upright, options).proof.volume);
}

TEST_CASE("bent works: rule hole-bend sees slots, and no opening that parts a bend") {
  const auto least = [](const WorkshopBuild& build) {
    double value = 1e9;
    std::string at;
    for (const ShopMeasurement& one : build.workshop.measured) {
      if (std::string(one.quantity) != "hole_bend_thicknesses" || !(one.value / one.unit < value)) continue;
      value = one.value / one.unit;
      at = one.where;
    }
    return std::pair(value, at);
  };
  PlateOptions options = bent(CornerJoint::tab_and_slot);
  options.walls = WallSeat::on_floor;
  const WorkshopBuild slots = plates_of(chute(), section::UChannel{WidthLaw(0.4), 0.25, 4e-3}, options);
  // Slots alone: 2 thicknesses off where a bend begins.
  CHECK(least(slots).first >= 2.0);
  CHECK(least(slots).first < 100.0);
  CHECK(least(slots).second.find("floor") != std::string::npos);
  PlateOptions openings = bent(CornerJoint::butt);
  openings.inspection = {{2.5, 0.5, 0.1, 8}};
  CHECK(least(plates_of(chute(), trapezoid(), openings)).first >= 2.0);
}

TEST_CASE("bent works: what is set on bent plates is bent as they are, and has its rows of the schedule") {
  const WorkshopBuild build = plates_of(chute(), trapezoid(), with_everything(CornerJoint::butt));
  for (const char* const name : {"cover", "rim", "tile", "floor"}) {
    INFO(name);
    std::size_t bends = 0;
    for (const ShopPart* const part : named(build, name)) {
      // Where an opening parts a bend it is one hit.
      const auto rows = std::count_if(build.workshop.bends.begin(), build.workshop.bends.end(),
                                      [&](const BendStep& step) { return step.part == part->number; });
      CHECK(rows == static_cast<std::ptrdiff_t>(part->pattern->bends.size()));
      bends += part->pattern->bends.size();
    }
    CHECK(bends > 0);
  }
  // Lines that an opening parts are one hit.
  std::size_t parted = 0;
  for (const ShopPart* const wall : named(build, "left_wall")) {
    const auto rows = std::count_if(build.workshop.bends.begin(), build.workshop.bends.end(),
                                    [&](const BendStep& step) { return step.part == wall->number; });
    CHECK(bend_hits(*wall->pattern) == static_cast<std::size_t>(rows));
    parted += wall->pattern->bends.size() - static_cast<std::size_t>(rows);
  }
  CHECK(parted > 0);
}

TEST_CASE(
    "bent works: random tracks, sections and works add up, clear one another, and are bolted pair by pair") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int built = 0;
  for (int run = 0; run < (testing::thorough() ? 12 : 3); ++run) {
    const ClothoidSpline track = testing::random_track(random, {.crest = -0.5, .valley = 0.8});
    const double t = random.between(2e-3, 5e-3);
    PlateOptions options =
        bent(std::vector{CornerJoint::butt, CornerJoint::lap, CornerJoint::tab_and_slot}[run % 3]);
    options.bend.value = Angle::from_degrees(random.between(1.0, 6.0)).radians();
    options.walls = random.integer(0, 1) == 0 ? WallSeat::beside_floor : WallSeat::on_floor;
    options.split.longest = random.between(0.8, 3.0);
    options.round = RoundMake::staves;
    options.stave_tolerance = 25e-3;
    if (random.integer(0, 1) == 0) options.liner.emplace().bolt = 6;
    if (random.integer(0, 1) == 0) options.rim.emplace();
    if (options.rim && random.integer(0, 1) == 0) options.cover.emplace();
    for (const section::Measures& measures :
         {section::Measures(section::Trapezoid{WidthLaw(random.between(0.25, 0.5)), random.between(0.1, 0.25),
                                               Angle::from_degrees(random.between(2.0, 50.0)), t}),
          section::Measures(section::VChannel{Angle::from_degrees(80.0), 0.05, 0.2, t}),
          section::Measures(section::HalfPipe{0.3, 0.05, t}),
          section::Measures(section::UChannel{WidthLaw(0.35), 0.2, t})}) {
      INFO(section::kind(measures) << " " << run);
      // Throws InternalError where parts clash, do not add up, or bolts do not meet.
      const std::string refusal = refusal_of([&] {
        const WorkshopBuild build = plates_of(track, measures, options);
        ++built;
        for (const ShopPart& part : build.workshop.parts) {
          CHECK(faults_of(part.pattern->region).empty());
          require_pattern_of_holes(part);
        }
        if (options.liner || options.cover) CHECK(build.proof.bolted > 0);
      });
      if (!refusal.empty()) CHECK(refusal.find('|') != std::string::npos);
    }
  }
  CHECK(built > (testing::thorough() ? 12 : 3));
}

TEST_CASE("bolts of tiles keep off the ends of tabs and off those of their slots, whatever the clearance") {
  PlateOptions options;
  options.split.longest = 2.9;
  options.liner.emplace();
  options.corners.kind = CornerJoint::tab_and_slot;
  int number = 0;
  for (const double clearance : {1e-3, 1.5e-3, 2e-3}) {
    for (const double spacing : {0.104, 0.217, 0.576}) {
      for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
        // Otherwise each of them with some of the others.
        ++number;
        if (!testing::thorough() && number % 5 != 1) continue;
        INFO("clearance " << clearance << ", spacing " << spacing);
        options.corners.clearance = clearance;
        options.corners.spacing = spacing;
        options.floor = floor;
        const WorkshopBuild build = plates(chute(), options);
        for (const ShopPart& part : build.workshop.parts) CHECK(faults_of(part.pattern->region).empty());
      }
    }
  }
}

}  // namespace bent_works_test
