// Plates that are wider than strips may be: cut along the track, off what is set in them. Every build proves that strips add up to
// the section and do not clash.

#include "parts/plates/seams.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/strips/section_seams.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace seams_test {

namespace {

using namespace glissade;
using namespace testing;

constexpr ChannelMeasures kWide{4.0, 0.5, 5e-3};

section::Trapezoid wide_trapezoid() {
  return {WidthLaw(4.0), 0.5, Angle::from_degrees(20.0), 5e-3};
}

PlaneBox box_of(const ShopPart& part) {
  return bounds(part.pattern->region.outline);
}

std::size_t holes_in(const WorkshopBuild& build, const std::string& word) {
  std::size_t count = 0;
  for (const ShopPart* const part : named(build, word))
    count += part->quantity() * part->pattern->region.holes.size();
  return count;
}

double edge_of(const ShopPart& part, const Circle& hole) {
  const PathPiece point{hole.centre, hole.centre + Vec2{1e-9, 0.0}, 0.0};
  double least = 1e300;
  for (const PathPiece& piece : pieces_of(part.pattern->region.outline))
    least = std::min(least, distance(point, piece));
  return least;
}

/// What holds of any build of strips: parts sound, within sheet and width, holes off all edges.
void require_strips(const WorkshopBuild& build, const PlateOptions& options) {
  CHECK(build.proof.pairs > 0);
  CHECK(build.proof.edge_mismatch < 1e-9);
  for (const ShopPart& part : build.workshop.parts) {
    INFO(part.name);
    CHECK(faults_of(part.pattern->region).empty());
    CHECK(fault_of(part) == "");
    const PlaneBox box = box_of(part);
    CHECK(std::max(box.width(), box.height()) <= options.split.sheet.x);
    CHECK(std::min(box.width(), box.height()) <= options.split.sheet.y);
    for (const Circle& hole : part.pattern->region.holes)
      CHECK(edge_of(part, hole) > 0.999 * 1.2 * 2.0 * hole.radius);
  }
}

/// The seams on the floor of each unit of a channel: places across from its left edge.
std::vector<std::vector<double>> floor_seams_of(const WorkshopBuild& build, std::size_t units) {
  std::vector<std::vector<double>> seams(units);
  for (std::size_t i = 0; i < units; ++i) {
    double at = 0.0;
    for (char letter = 'a'; letter <= 'z'; ++letter) {
      const auto strips = named(build, std::string("floor_") + letter + "_" + std::to_string(i + 1));
      if (strips.empty()) break;
      at += box_of(*strips.front()).height();
      seams[i].push_back(at);
    }
    if (!seams[i].empty()) seams[i].pop_back();
  }
  return seams;
}

}  // namespace

TEST_CASE("seams: a floor of 4 m is three equal strips of a sheet of 1.5 m, and its frames are cut to it") {
  const PlateOptions options;
  for (const FloorMake make : {FloorMake::rolled, FloorMake::bent}) {
    PlateOptions own = options;
    own.floor = make;
    const WorkshopBuild build = plates(chute(), own, kWide);
    require_strips(build, own);
    double wide = 0.0;
    for (const ShopPart* const floor : named(build, "floor")) {
      CHECK(floor->quantity() == 3);
      CHECK(box_of(*floor).height() == Approx(4.0 / 3.0).epsilon(1e-12));
      wide += static_cast<double>(floor->quantity()) * floor->volume;
    }
    PlateOptions large = own;
    large.split.sheet = {9.0, 5.0};
    large.split.longest = 2.9;
    const WorkshopBuild whole = plates(chute(), large, kWide);
    CHECK(named(whole, "floor_a").empty());
    double one = 0.0;
    for (const ShopPart* const floor : named(whole, "floor")) one += floor->volume;
    if (make == FloorMake::rolled) CHECK(wide == Approx(one).epsilon(1e-12));
    // The pieces of a frame have its bolts.
    CHECK(named(build, "end_frame").size() == 4);
    CHECK(holes_in(build, "end_frame") == holes_in(whole, "end_frame"));
    CHECK(build.workshop.items.front().quantity == whole.workshop.items.front().quantity);
    const auto noted =
        std::find_if(build.workshop.notes.begin(), build.workshop.notes.end(), [](const auto& note) {
          return note.find("welded edge to edge along the track: 15.") != std::string::npos;
        });
    CHECK(noted != build.workshop.notes.end());
  }
}

TEST_CASE("seams: strips of leaning plates add up to the section, whatever is set in them") {
  for (const WallSeat seat : {WallSeat::beside_floor, WallSeat::on_floor}) {
    // One seat alone, elsewhere than in CI.
    if (seat == WallSeat::beside_floor && !testing::thorough()) continue;
    PlateOptions options;
    options.walls = seat;
    options.corners.kind = CornerJoint::tab_and_slot;
    options.liner.emplace();
    options.rim.emplace();
    const WorkshopBuild build = plates_of(chute(), wide_trapezoid(), options);
    require_strips(build, options);
    CHECK(named(build, "floor_c_1").size() == 1);
    CHECK(named(build, "wall_a").empty());
    options.split.widest = 0.3;
    const WorkshopBuild narrow = plates_of(chute(), wide_trapezoid(), options);
    require_strips(narrow, options);
    CHECK(named(narrow, "left_wall_b_1").size() == 1);
    CHECK(narrow.proof.exact_volume == Approx(build.proof.exact_volume).epsilon(1e-12));
    for (const ShopPart* const floor : named(narrow, "floor")) CHECK(box_of(*floor).height() < 0.3 + 1e-9);
  }
}

TEST_CASE("seams: units that are welded end to end have their seams 200 mm apart, flanged ones in line") {
  PlateOptions options;
  const auto flanged = floor_seams_of(plates(chute(), options, {4.1, 0.5, 5e-3}), 3);
  CHECK(flanged[0] == flanged[1]);
  options.flanges.wanted = false;
  const WorkshopBuild build = plates(chute(), options, {4.1, 0.5, 5e-3});
  require_strips(build, options);
  const auto welded = floor_seams_of(build, 3);
  REQUIRE(welded[0].size() >= 2);
  for (std::size_t i = 0; i + 1 < welded.size(); ++i) {
    for (const double seam : welded[i]) {
      for (const double other : welded[i + 1]) CHECK(std::fabs(seam - other) > 0.2 - 1e-9);
    }
  }
}

TEST_CASE("seams: of any section whose units are welded end to end none goes on in one of the next unit") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int strips = 0;
  const int runs = testing::thorough() ? 12 : 4;
  for (int run = 0; run < runs; ++run) {
    PlateOptions options;
    options.flanges.wanted = run % 4 == 3;
    options.split.widest = random.between(0.25, 0.7);
    options.split.longest = random.between(1.5, 3.0);
    options.bend.rule = FacetRule::segment_angle;
    options.bend.value = 0.1;
    options.floor = random.integer(0, 2) == 0 ? FloorMake::bent : FloorMake::rolled;
    const bool rolled = options.floor == FloorMake::rolled;
    const double wide = random.between(1.2, 3.0);
    const double high = random.between(0.4, 1.2);
    const bool widens = random.integer(0, 2) == 0;
    const WidthLaw width = widens ? WidthLaw({{1.0, wide}, {3.0, wide - 0.05}}) : WidthLaw(wide);
    const section::Measures sections[] = {section::Trapezoid{width, high, Angle::from_degrees(30.0), 4e-3},
                                          section::UChannel{width, high, 4e-3}};
    const section::Measures& measures = sections[random.integer(0, 1)];
    if (!widens && rolled && random.integer(0, 1) == 0) options.liner.emplace();
    if (!widens && rolled && random.integer(0, 1) == 0) options.corners.kind = CornerJoint::lap;
    if (!widens && random.integer(0, 1) == 0) options.inspection = {{2.0, 0.08, 0.06, 6}};
    CAPTURE(run, wide, high, widens, rolled, measures.index(), *options.split.widest);
    const parts::PlateSection section = parts::with_seams(*parts::plate_section(measures, options), options);
    REQUIRE(section.plates_of(0).size() == section.plates_of(1).size());
    for (const std::size_t a : section.seams) {
      for (const std::size_t b : section.seams) {
        const double apart = norm(section.plates_of(0)[a].face_from - section.plates_of(1)[b].face_from);
        if (options.flanges.wanted)
          CHECK((a != b || apart == 0.0));
        else if (widens && section.plates_of(0)[a].name.starts_with("floor"))
          CHECK(apart > 0.0);
        else
          CHECK(apart >= std::min(0.05, 0.125 * 0.5 * *options.split.widest));
      }
    }
    strips += section.seams.empty() ? 0 : 1;
    // The build proves volumes, edges and that nothing clashes.
    WorkshopBuild build;
    const std::string told = refusal_of([&] { build = plates_of(chute(), measures, options); });
    INFO(told);
    CHECK((told.empty() || told.find("inspection|") == 0));
    if (told.empty()) CHECK(build.proof.pairs > 0);
  }
  CHECK(strips > runs * 2 / 3);
}

TEST_CASE("seams: narrow strips are staggered by half a strip, and every seam lies on the plate") {
  PlateOptions options;
  options.flanges.wanted = false;
  options.corners.kind = CornerJoint::tab_and_slot;
  options.split.longest = 1.5;
  for (const double widest : {0.06, 0.1, 0.15, 0.2268, 0.3}) {
    INFO("strips of " << widest);
    options.split.widest = widest;
    const WorkshopBuild build = plates(chute(), options, {0.75, 0.11, 5e-3});
    require_strips(build, options);
    for (const ShopPart* const floor : named(build, "floor")) {
      CHECK(floor->volume > 0.0);
      CHECK(box_of(*floor).height() <= widest + 1e-9);
    }
  }
}

TEST_CASE("seams: of a floor that widens the strip in the middle takes the change") {
  section::UChannel channel;
  channel.width = WidthLaw({{1.0, 3.5}, {4.0, 3.1}});
  channel.wall_height = 0.4;
  channel.thickness = 5e-3;
  const PlateOptions options;
  const WorkshopBuild build = plates_of(chute(), channel, options);
  require_strips(build, options);
  const ShopPart& side = part_of(build, "floor_a_1");
  const ShopPart& middle = part_of(build, "floor_b_1");
  CHECK(named(build, "floor_d").empty());
  // Areas: of the side everywhere as wide; of the middle by what is left.
  const double length = box_of(middle).width();
  CHECK(signed_area(side.pattern->region.outline) / length == Approx(3.5 / 3.0).epsilon(2e-3));
  CHECK(signed_area(part_of(build, "floor_b_3").pattern->region.outline) /
            box_of(part_of(build, "floor_b_3")).width() ==
        Approx(3.1 - 2.0 * 3.5 / 3.0).epsilon(2e-3));
}

TEST_CASE("seams: random tracks, sections and strips make plates that add up, with no clash") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 5; ++run) {
    const double size = random.between(3.0, 9.0);
    std::vector<ClothoidSegment> segments;
    for (int i = random.integer(1, 4); i > 0; --i) {
      const double curvature = random.between(-0.4, 0.6) / size;
      segments.push_back(
          {random.between(0.15, 0.4) * size, curvature, random.integer(0, 1) == 0 ? curvature : 0.0});
    }
    const ClothoidSpline track(Angle::from_degrees(random.between(30.0, 60.0)), segments);
    PlateOptions options;
    options.split.widest = random.between(0.25, 0.9);
    options.floor = random.integer(0, 2) == 0 ? FloorMake::bent : FloorMake::rolled;
    options.bend.rule = FacetRule::segment_angle;
    options.bend.value = random.between(0.03, 0.15);
    options.flanges.wanted = random.integer(0, 2) != 0;
    const bool rolled = options.floor == FloorMake::rolled;
    if (rolled && random.integer(0, 1) == 0) options.liner.emplace();
    if (rolled && random.integer(0, 2) == 0)
      options.corners.kind = random.integer(0, 1) == 0 ? CornerJoint::lap : CornerJoint::tab_and_slot;
    if (rolled && random.integer(0, 1) == 0) options.walls = WallSeat::on_floor;
    const double wide = random.between(0.6, 4.0);
    const double high = random.between(0.1, 0.6);
    const double t = random.between(3e-3, 8e-3);
    const section::Measures sections[] = {
        section::UChannel{WidthLaw(wide), high, t},
        section::Trapezoid{WidthLaw(wide), high, Angle::from_degrees(25.0), t}};
    const WorkshopBuild build = plates_of(track, sections[random.integer(0, 1)], options);
    require_strips(build, options);
    for (const ShopPart* const floor : named(build, "floor"))
      CHECK(std::min(box_of(*floor).height(), box_of(*floor).width()) <= *options.split.widest + 0.01);
  }
}

TEST_CASE("seams of sections go beside openings and their lids, which lie in one strip") {
  const section::Trapezoid trapezoid{WidthLaw(1.3), 0.35, Angle::from_degrees(25.0), 5e-3};
  PlateOptions options;
  options.inspection = {{3.0, 0.2, 0.15, 8}};
  // Of 386 mm: strips of 193 mm, or less, hold no lid of 210 mm.
  for (const FloorMake floor : {FloorMake::rolled, FloorMake::bent}) {
    for (const double widest : {0.22, 0.24, 0.3}) {
      INFO("widest " << widest);
      // The ends of the range of a rolled floor, the middle of a bent one, elsewhere than in CI.
      if (!testing::thorough() && (widest == 0.24) != (floor == FloorMake::bent)) continue;
      options.floor = floor;
      options.split.widest = widest;
      const WorkshopBuild build = plates_of(chute(), trapezoid, options);
      std::size_t opened = 0;
      for (const ShopPart* const wall : named(build, "left_wall")) {
        for (const ArcPath& cutout : wall->pattern->region.cutouts)
          opened += bounds(cutout).width() > 0.1 ? 1 : 0;
      }
      CHECK(opened == 1);
    }
    options.split.widest = 0.15;
    CHECK(
        refusal_of([&] { return plates_of(chute(), trapezoid, options); }) ==
        "split.widest|the left_wall, 388.9 mm wide, leaves no place for seams that make strips of 150 mm or "
        "less|Seams keep off laps, slots, openings and holes.|widest: 220 mm\n");
  }
}

TEST_CASE("seams: a larger sheet never makes impossible what a smaller one holds") {
  // A floor of 410 mm lies across a sheet of 600 x 300 mm, in units of less than that; so it does on a longer one.
  PlateOptions options;
  options.split.sheet = {0.6, 0.3};
  const std::size_t joints = plates(chute(), options).joints.size();
  for (const double longer : {0.9, 1.0, 2.0, 6.0}) {
    options.split.sheet = {longer, 0.3};
    CHECK(plates(chute(), options).joints.size() == joints);
  }
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int runs = testing::thorough() ? 12 : 1;
  for (int run = 0; run < runs; ++run) {
    const double wide = random.between(0.3, 0.6);
    const section::Measures sections[] = {
        section::UChannel{WidthLaw(wide), 0.15, 4e-3}, section::Slab{WidthLaw(wide), 4e-3},
        section::Trapezoid{WidthLaw(wide), 0.15, Angle::from_degrees(20.0), 4e-3}};
    const int kind = random.integer(0, 2);
    const section::Measures& measures = sections[kind];
    PlateOptions all;
    if (kind != 1 && random.integer(0, 1) == 0) all.corners.kind = CornerJoint::lap;
    all.split.sheet = {random.between(0.2, 0.5), random.between(0.12, 0.2)};
    bool holds = false;
    std::string last;
    for (int growth = 0; growth < 7; ++growth) {
      CAPTURE(run, measures.index(), wide, all.split.sheet.x, all.split.sheet.y, last);
      const std::string text = refusal_of([&] { return plates_of(chute(), measures, all); });
      INFO(text);
      CHECK((text.empty() || !holds));
      holds = holds || text.empty();
      last = text;
      (random.integer(0, 1) == 0 ? all.split.sheet.x : all.split.sheet.y) *= random.between(1.05, 1.6);
    }
    CHECK(holds);
  }
}

TEST_CASE("seams: what cannot be cut is refused with place, value, bound and a way out") {
  PlateOptions options;
  options.split.widest = 20e-3;
  CHECK(refusal(options) ==
        "split.widest|widest: 20 mm is too narrow|Strips that are welded along the track are at least 50 mm "
        "wide.|widest: 1 m\n");
  options.split.widest = 1.0;
  options.split.allowed = false;
  CHECK(refusal(options).find(
            "split.widest|widest beside allowed: false|One piece is asked for, and strips.") !=
        std::string::npos);
  PlateOptions holes;
  holes.split.widest = 60e-3;
  holes.liner.emplace();
  holes.liner->tile_width = 70e-3;
  holes.liner->thickness = 8e-3;
  holes.liner->bolt = 10;
  CHECK(refusal(holes).find(
            "split.widest|the floor, 400 mm wide, leaves no place for seams that make strips of 60 "
            "mm or less|Seams keep off laps, slots, openings and holes.|widest: 400 mm") !=
        std::string::npos);
  section::UChannel channel;
  channel.width = WidthLaw({{1.0, 1.5}, {4.0, 0.7}});
  channel.wall_height = 0.25;
  channel.thickness = 4e-3;
  PlateOptions narrow;
  narrow.split.widest = 0.2;
  CHECK(refusal_of([&] {
          return plates_of(chute(), channel, narrow);
        }).find("leave nothing of the one in the middle") != std::string::npos);
}

}  // namespace seams_test
