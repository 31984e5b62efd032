// Frames, rings and stiffeners larger than the sheet, cut between their bolts. Every build proves that pieces do not clash and
// that every hole meets its like.

#include "parts/frame_pieces.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/slot.hpp"
#include "glissade/parts/nest.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/refusals.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace glissade;
using namespace testing;

/// Area, bolts and masses of all parts in whose names a word stands.
struct Sums {
  double area = 0.0;
  double mass = 0.0;
  std::size_t bolts = 0;
  std::size_t pieces = 0;
};

Sums sums_of(const WorkshopBuild& build, const std::string& word) {
  Sums sums;
  for (const ShopPart* const part : named(build, word)) {
    const PlaneRegion& region = part->pattern->region;
    const auto count = static_cast<double>(part->quantity());
    sums.area += count * moments(region).area;
    sums.mass += count * part->mass;
    std::size_t bolts = region.holes.size();
    for (const ArcPath& cutout : region.cutouts) bolts += as_slot(cutout) ? 1 : 0;
    sums.bolts += part->quantity() * bolts;
    sums.pieces += part->quantity();
  }
  return sums;
}

void require_pieces(const WorkshopBuild& build, const PlateOptions& options, const std::string& word) {
  for (const ShopPart* const part : named(build, word)) {
    INFO(part->name);
    const PlaneRegion& region = part->pattern->region;
    CHECK(faults_of(region).empty());
    // By chords, which of long arcs hold next to nothing.
    const auto& corners = region.outline.vertices;
    if (std::all_of(corners.begin(), corners.end(), [](const auto& corner) { return corner.bulge == 0.0; }))
      CHECK(fault_of(*part) == "");
    const PlaneBox box = bounds(region.outline);
    CHECK(std::max(box.width(), box.height()) <= options.split.stock().room().x + 1e-9);
    CHECK(std::min(box.width(), box.height()) <= options.split.stock().room().y + 1e-9);
    for (const Circle& hole : region.holes) {
      const PathPiece point{hole.centre, hole.centre + Vec2{1e-9, 0.0}, 0.0};
      for (const PathPiece& piece : pieces_of(region.outline))
        CHECK(distance(point, piece) > 0.999 * options.shop.hole_edge_diameters * 2.0 * hole.radius);
    }
  }
}

/// The same on a sheet that takes everything in one.
PlateOptions on_large_sheets(PlateOptions options, double longest) {
  options.split.sheet = {30.0, 20.0};
  options.split.longest = longest;
  return options;
}

ClothoidSpline hill(double size) {
  return {Angle::from_degrees(50.0), {{0.5 * size, 0.0, 0.0}, {0.5 * size, 0.3 / size, 0.3 / size}}};
}

}  // namespace

TEST_CASE("frame pieces: a closed frame larger than the sheet is pieces that add up to it, with its bolts") {
  PlateOptions options;
  options.round = RoundMake::staves;
  options.stave_tolerance = 20e-3;
  options.stiffeners.emplace();
  const section::Pipe pipe{2.6, 5e-3};
  for (const bool slotted : {false, true}) {
    if (slotted) options.flanges.slotted = FlangeSide::downstream;
    const WorkshopBuild build = plates_of(hill(6.0), pipe, options);
    require_pieces(build, options, "end_frame");
    require_pieces(build, options, "stiffener");
    CHECK(!nest(build.workshop, options.split.stock()).empty());
    const double longest = build.joints[1] - build.joints[0] + 1e-6;
    const WorkshopBuild whole = plates_of(hill(6.0), pipe, on_large_sheets(options, longest));
    for (const char* const word : {"end_frame", "stiffener"}) {
      INFO(word << (slotted ? ", slotted" : ""));
      const Sums cut = sums_of(build, word);
      const Sums one = sums_of(whole, word);
      // Halves of stiffeners fit.
      CHECK(cut.pieces > one.pieces - (word[0] == 's' ? 1 : 0));
      CHECK(cut.area == Approx(one.area).epsilon(1e-12));
      CHECK(cut.mass == Approx(one.mass).epsilon(1e-12));
      CHECK(cut.bolts == one.bolts);
    }
    CHECK(build.proof.bolted == whole.proof.bolted);
  }
}

TEST_CASE("frame pieces: the ring of a mitred pipe is equal arcs where bolts allow it") {
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.split.sheet = {3.0, 0.6};
  options.bend.rule = FacetRule::bends;
  options.bend.value = 24.0;
  const section::Pipe pipe{0.8, 4e-3};
  const WorkshopBuild build = plates_of(hill(4.0), pipe, options);
  require_pieces(build, options, "pipe_flange");
  // One number for all arcs of a side.
  CHECK(named(build, "pipe_flange").size() == 2);
  const WorkshopBuild whole =
      plates_of(hill(4.0), pipe, on_large_sheets(options, build.joints[1] - build.joints[0] + 1e-6));
  // The units may be more of them.
  const double rings = static_cast<double>(sums_of(whole, "pipe_flange").pieces);
  const double cut = static_cast<double>(build.joints.size() - 1) * 2.0;
  CHECK(sums_of(build, "pipe_flange").area ==
        Approx(sums_of(whole, "pipe_flange").area * cut / rings).epsilon(1e-12));
}

TEST_CASE("frame pieces: frames that meet are cut at different bolts, high walls do not keep them whole") {
  // Two halves of it would be as high as the walls: larger than the sheet.
  const ChannelMeasures deep{2.4, 1.8, 5e-3};
  PlateOptions options;
  options.split.sheet = {3.0, 1.2};
  options.stiffeners.emplace();
  const WorkshopBuild build = plates(hill(8.0), options, deep);
  require_pieces(build, options, "frame");
  require_pieces(build, options, "stiffener");
  CHECK(!nest(build.workshop, options.split.stock()).empty());
  for (const ShopPart* const one : named(build, "end_frame_")) {
    for (const ShopPart* const other : named(build, "end_frame_")) {
      if (one == other ||
          (one->name.find("loose") == std::string::npos) == (other->name.find("loose") == std::string::npos))
        continue;
      CHECK(moments(one->pattern->region).area != Approx(moments(other->pattern->region).area).epsilon(1e-6));
    }
  }
}

TEST_CASE(
    "frame pieces: frames that the sheet takes whole are as many pieces as are asked for, and take fewer "
    "sheets") {
  PlateOptions options;
  options.round = RoundMake::staves;
  options.stave_tolerance = 20e-3;
  options.stiffeners.emplace();
  for (const section::Measures& measures :
       {section::Measures{section::HalfPipe{1.2, 0.3, 4e-3}}, section::Measures{section::Pipe{1.1, 4e-3}}}) {
    options.split.frames = 1;
    const WorkshopBuild whole = plates_of(hill(6.0), measures, options);
    options.split.frames = 3;
    const WorkshopBuild cut = plates_of(hill(6.0), measures, options);
    for (const char* const word : {"end_frame", "stiffener"}) {
      INFO(word);
      CHECK(sums_of(cut, word).pieces == 3 * sums_of(whole, word).pieces);
      CHECK(sums_of(cut, word).area == Approx(sums_of(whole, word).area).epsilon(1e-12));
      CHECK(sums_of(cut, word).bolts == sums_of(whole, word).bolts);
    }
    CHECK(nest(cut.workshop, options.split.stock()).size() <
          nest(whole.workshop, options.split.stock()).size());
    CHECK(cut.proof.bolted == whole.proof.bolted);
  }
}

TEST_CASE("frame pieces: more of them than bolts leave room for are refused, with how many there are") {
  PlateOptions options;
  options.split.frames = 40;
  const ChannelMeasures channel{0.5, 0.3, 4e-3};
  const std::string told = refusal_of([&] { return plates(hill(4.0), options, channel); });
  CHECK(told.find("split.frames|frames: end_frame is not to be had in 40 pieces|Cuts lie square between two "
                  "bolts, off "
                  "corners and off holes.|frames: ") != std::string::npos);
  options.split.frames = std::stoi(told.substr(told.rfind(' ')));
  CHECK_NOTHROW(plates(hill(4.0), options, channel));
  // No cut runs along a wall, into the corner below it.
  for (int count = 2; count < 12; ++count) {
    INFO(count);
    options.split.frames = count;
    const std::string refused = refusal_of([&] { return plates(hill(4.0), options, channel); });
    CHECK((refused.empty() || refused.find("split.frames|") == 0));
  }
  options.split.frames = 0;
  CHECK(refusal_of([&] { return plates(hill(4.0), options, channel); }) ==
        "split.frames|frames: 0 lies outside 1 to 60|So many pieces make a frame, a ring or a "
        "stiffener.|frames: 3\n");
  options.split.frames = 2;
  options.split.allowed = false;
  CHECK(refusal_of([&] { return plates(hill(4.0), options, channel); }) ==
        "split.frames|frames: 2 beside allowed: false|One piece is asked for, and pieces.|one of them\n");
}

TEST_CASE("frame pieces: random sections, sheets and bolts make pieces that add up to their frames") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < 8; ++run) {
    const double wide = random.between(1.0, 3.0);
    const double t = random.between(4e-3, 8e-3);
    PlateOptions options;
    options.split.sheet = {3.0, random.between(0.45, 0.9)};
    options.round = RoundMake::staves;
    options.stave_tolerance = random.between(5e-3, 30e-3);
    options.flanges.pitch = random.between(40e-3, 250e-3);
    options.flanges.gap = 2e-3;
    options.flanges.as_told = true;
    if (random.integer(0, 1) == 0) options.stiffeners.emplace();
    if (random.integer(0, 2) == 0) options.rim.emplace();
    const section::Measures sections[] = {
        section::UChannel{WidthLaw(wide), random.between(0.2, 0.8), t},
        section::Trapezoid{WidthLaw(wide), random.between(0.2, 0.8), Angle::from_degrees(25.0), t},
        section::Slab{WidthLaw(wide), t},
        section::UChannel{WidthLaw({{1.0, wide}, {3.0, 0.8 * wide}}), 0.4, t},
        section::HalfPipe{wide, 0.2, t}};
    const auto& section = sections[random.integer(0, 4)];
    if (std::holds_alternative<section::Slab>(section)) options.rim.reset();
    CAPTURE(run, wide, section.index());
    const WorkshopBuild build = plates_of(hill(random.between(3.0, 7.0)), section, options);
    require_pieces(build, options, "frame");
    require_pieces(build, options, "stiffener");
  }
}
