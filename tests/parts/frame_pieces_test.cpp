// Frames, rings and stiffeners larger than the sheet, cut between their bolts. Every build proves that pieces do not clash and
// that every hole meets its like.

#include "parts/plates/frame_pieces.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/slot.hpp"
#include "glissade/parts/nest.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/refusals.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
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
  int made = 0;
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
    std::optional<WorkshopBuild> build;
    const std::string refused =
        refusal_of([&] { return build = plates_of(hill(random.between(3.0, 7.0)), section, options); });
    // Strips of a floor whose width changes by more than the middle one has.
    if (refused.find("leave nothing of the one in the middle") != std::string::npos) continue;
    REQUIRE(refused.empty());
    require_pieces(*build, options, "frame");
    require_pieces(*build, options, "stiffener");
    ++made;
  }
  CHECK(made > 3);
}

TEST_CASE(
    "frame pieces: no part is heavier than the heaviest; where one cannot be lighter a mass is told that "
    "does") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int cut = 0;
  for (int run = 0; run < (testing::thorough() ? 16 : 8); ++run) {
    const double wide = random.between(0.8, 2.0);
    const double t = random.between(3e-3, 6e-3);
    PlateOptions options;
    options.split.sheet = {6.0, 2.5};
    options.round = random.integer(0, 1) == 0 ? RoundMake::staves : RoundMake::mitred;
    options.stave_tolerance = 15e-3;
    options.bend = {FacetRule::segment_angle, 6.0 * 0.0174533, {}, {}};
    if (random.integer(0, 1) == 0) {
      options.flanges.section = FlangeSection::angle;
      options.flanges.thickness = 6e-3;
      options.flanges.width = 60e-3;
    }
    if (random.integer(0, 1) == 0) options.stiffeners.emplace();
    if (random.integer(0, 2) == 0) options.lifting.emplace();
    const section::Measures sections[] = {
        section::UChannel{WidthLaw(wide), random.between(0.2, 0.5), t},
        section::Trapezoid{WidthLaw(wide), random.between(0.2, 0.5), Angle::from_degrees(25.0), t},
        section::Pipe{wide, t}, section::HalfPipe{wide, 0.2, t}};
    const auto& section = sections[run % 4];
    options.split.heaviest = random.between(1.0, 40.0);
    CAPTURE(run, wide, section.index(), options.round, *options.split.heaviest);
    WorkshopBuild build;
    std::string refused = refusal_of([&] { build = plates_of(hill(5.0), section, options); });
    // Of plates along the track any mass is met by shorter units, down to those between frames.
    if (refused.find("split|") == 0 || refused.find("has no room for the frames") != std::string::npos)
      continue;
    for (int tries = 0; tries < 3 && !refused.empty(); ++tries) {
      INFO(refused);
      REQUIRE(refused.find("split.heaviest|heaviest: ") == 0);
      options.split.heaviest = std::stod(refused.substr(refused.rfind("|heaviest: ") + 11));
      refused = refusal_of([&] { build = plates_of(hill(5.0), section, options); });
    }
    CHECK(refused == "");
    for (const ShopPart& part : build.workshop.parts) {
      INFO(part.name);
      CHECK(part.mass <= *options.split.heaviest * (1.0 + 1e-9));
    }
    cut += sums_of(build, "frame_a").pieces > 0 || sums_of(build, "stiffener_a").pieces > 0;
  }
  CHECK(cut > (testing::thorough() ? 2 : 0));
}

TEST_CASE(
    "frame pieces: frames whose bolts leave no room for lighter pieces are refused with the mass of theirs") {
  PlateOptions options;
  options.flanges.width = 80e-3;
  options.flanges.pitch = 0.25;
  options.flanges.thickness = 12e-3;
  options.flanges.as_told = true;
  const ChannelMeasures channel{0.3, 0.3, 2e-3};
  options.split.heaviest = 0.9;
  const auto refused = [&] { return refusal_of([&] { return plates(hill(2.0), options, channel); }); };
  const std::string told = refused();
  INFO(told);
  REQUIRE(told.find("split.heaviest|heaviest: 0.9 kg, and end_frame weighs ") == 0);
  CHECK(told.find("|Cuts of it lie square between two bolts, off corners and off holes.|") !=
        std::string::npos);
  options.split.heaviest = std::stod(told.substr(told.rfind("|heaviest: ") + 11));
  CHECK(refused() == "");
  options.split.heaviest = 0.98 * *options.split.heaviest;
  CHECK(refused().find("split.heaviest|") == 0);
}

TEST_CASE("frame pieces: a frame too heavy for one piece is refused where one is asked for") {
  PlateOptions options;
  options.split.sheet = {6.0, 2.5};
  options.split.allowed = false;
  options.stiffeners = StiffenerOptions{};
  const ChannelMeasures channel{0.5, 0.3, 4e-3};
  const WorkshopBuild whole = plates(hill(2.0), options, channel);
  double frame = 0.0;
  for (const ShopPart& part : whole.workshop.parts) {
    if (part.name == "end_frame") frame = part.mass;
  }
  options.split.heaviest = 0.9 * frame;
  CHECK(refusal_of([&] { return plates(hill(2.0), options, channel); }).find("One piece is asked for") !=
        std::string::npos);
}

TEST_CASE("frame pieces: units too short for the frames at their ends are refused with a length that does") {
  PlateOptions options;
  int combination = 0;
  for (const FlangeSection section : {FlangeSection::flat, FlangeSection::angle}) {
    options.flanges.section = section;
    options.flanges.thickness = 6e-3;
    for (const double longest : {0.01, 0.05, 0.1}) {
      for (const section::Measures& measures :
           {section::Measures{section::Trapezoid{WidthLaw(1.3), 0.4, Angle::from_degrees(25.0), 4e-3}},
            section::Measures{section::UChannel{WidthLaw(0.5), 0.3, 4e-3}},
            section::Measures{section::VChannel{Angle::from_degrees(100.0), 0.4, 0.1, 4e-3}}}) {
        // Each length with one of the three in turn, elsewhere than in CI.
        const int number = combination++;
        if (!testing::thorough() && number % 3 != number / 3 % 3) continue;
        options.split.longest = longest;
        CAPTURE(section, longest, measures.index());
        const ClothoidSpline track(Angle::from_degrees(45.0), {{1.2, 0.3, 0.3}});
        const std::string told = refusal_of([&] { return plates_of(track, measures, options); });
        if (told.empty()) continue;
        INFO(told);
        REQUIRE(told.find("split.longest|longest: unit ") == 0);
        const std::size_t hint = told.find("|longest: ", 20);
        std::size_t unit = 0;
        const double value = std::stod(told.substr(hint + 10), &unit);
        options.split.longest =
            (told[hint + 10 + unit + 1] == 'm' && told[hint + 12 + unit] == 'm' ? 1e-3 : 1.0) * value;
        CHECK_NOTHROW(plates_of(track, measures, options));
      }
    }
  }
}

TEST_CASE(
    "frame pieces: units from an upright start on have room for frames, however far their walls fold there") {
  PlateOptions options;
  options.split.longest = 1.5;
  options.split.widest = 1.0;
  options.round = RoundMake::staves;
  options.stave_tolerance = 3e-3;
  options.flanges.section = FlangeSection::angle;
  options.flanges.width = 80e-3;
  options.flanges.thickness = 8e-3;
  const CoulombBrachistochrone track({3.368, 5.469}, Friction::from_angle(Angle::from_degrees(12.8)));
  section::VChannel channel;
  channel.angle = Angle::from_degrees(93.0);
  channel.wall_height = 0.8;
  channel.bottom_radius = 0.083;
  channel.thickness = 5e-3;
  const std::string told = refusal_of([&] { return plates_of(track, channel, options); });
  INFO(told);
  CHECK(told.find("has no room for the frames") == std::string::npos);
}
