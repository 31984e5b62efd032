// Angles, tubes and flat bars longer than what they come in. Every build proves that their pieces do not clash and that every
// hole meets its like.

#include "parts/plates/bar_pieces.hpp"

#include "glissade/core/slot.hpp"
#include "glissade/parts/plates.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/angle_bar.hpp"
#include "parts/bodies/body_mesh.hpp"
#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace bar_pieces_test {

namespace {

using namespace glissade;
using namespace testing;

PlateOptions with_angles(double bar) {
  PlateOptions options;
  options.flanges.as_told = true;
  options.flanges.section = FlangeSection::angle;
  options.split.longest = 2.5;
  options.split.bar = bar;
  return options;
}

struct Bars {
  double volume = 0.0;
  double longest = 0.0;
  std::size_t bolts = 0;
  std::size_t pieces = 0;
  std::size_t parts = 0;
};

/// All angles, each of them sound.
Bars angles_of(const WorkshopBuild& build) {
  Bars bars;
  for (const ShopPart& part : build.workshop.parts) {
    const auto* const bar = std::get_if<AngleBar>(&part.body);
    if (bar == nullptr) continue;
    INFO(part.name);
    CHECK(faults_of(part.pattern->region).empty());
    if (!parts::is_rolled(*bar)) CHECK(fault_of(part).empty());
    const MeshFacts mesh = measure(parts::facets_of(part.body, 1e-5));
    CHECK(mesh.boundary_edges + mesh.non_manifold_edges + mesh.self_intersections == 0);
    CHECK(std::fabs(mesh.volume / part.volume - 1.0) < 1e-3);
    bars.volume += part.volume * static_cast<double>(part.quantity());
    bars.longest = std::max(bars.longest, parts::stock_length(*bar));
    bars.bolts += part.quantity() * (bar->holes.size() + bar->slots.size());
    bars.pieces += part.quantity();
    ++bars.parts;
  }
  return bars;
}

bool has_note(const WorkshopBuild& build, const std::string& text) {
  return std::any_of(build.workshop.notes.begin(), build.workshop.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("bar pieces: frames and rings of angles longer than a bar are pieces that add up to them") {
  const section::Measures sections[] = {section::UChannel{WidthLaw(2.0), 0.3, 5e-3}, section::Pipe{0.8, 4e-3},
                                        section::HalfPipe{0.9, 0.15, 4e-3}, section::HalfPipe{0.9, 0.0, 4e-3},
                                        section::Slab{WidthLaw(2.0), 5e-3}};
  int combination = 0;
  for (const section::Measures& section : sections) {
    for (const bool slotted : {false, true}) {
      // Elsewhere than in CI each section with one of the two, by turns.
      const int number = combination++;
      if (!testing::thorough() && number % 2 != number / 2 % 2) continue;
      CAPTURE(section.index(), slotted);
      PlateOptions options = with_angles(1.1);
      options.round = RoundMake::mitred;
      options.bend.rule = FacetRule::segment_angle;
      options.bend.value = 0.08;
      options.flanges.width = 80e-3;
      options.flanges.thickness = 8e-3;
      if (slotted) options.flanges.slotted = FlangeSide::upstream;
      const WorkshopBuild build = plates_of(chute(), section, options);
      options.split.bar = 12.0;
      const WorkshopBuild whole = plates_of(chute(), section, options);
      const Bars cut = angles_of(build);
      const Bars one = angles_of(whole);
      CHECK(one.longest > 1.1);
      CHECK(cut.longest <= 1.1 + 1e-9);
      CHECK(cut.pieces > one.pieces);
      CHECK(cut.bolts == one.bolts);
      CHECK(cut.volume == Approx(one.volume).epsilon(1e-12));
      CHECK(build.proof.bolted == whole.proof.bolted);
      CHECK(has_note(build, "Bars longer than the 1.1 m"));
      CHECK(!has_note(whole, "Bars longer"));
    }
  }
}

TEST_CASE("bar pieces: tubes and flat bars of trestles are cut to what they come in") {
  PlateOptions options;
  options.supports.emplace();
  options.supports->ground = {{0.0, -9.0}};
  options.supports->braced_from = 1.0;
  const WorkshopBuild whole = plates(chute(), options);
  options.split.bar = 1.3;
  options.split.sheet = {1.2, 0.9};
  options.split.longest = 0.6;
  PlateOptions long_bars = options;
  long_bars.split.bar = 100.0;
  const WorkshopBuild one = plates(chute(), long_bars);
  const WorkshopBuild cut = plates(chute(), options);
  const auto sum = [](const WorkshopBuild& build) {
    double volume = 0.0;
    for (const ShopPart& part : build.workshop.parts)
      volume += part.stands ? part.volume * static_cast<double>(part.quantity()) : 0.0;
    return volume;
  };
  CHECK(sum(cut) == Approx(sum(one)).epsilon(1e-12));
  double longest = 0.0;
  for (const ShopPart& part : cut.workshop.parts) {
    if (!part.bought_in) continue;
    INFO(part.name);
    const double length =
        part.pattern ? bounds(part.pattern->region.outline).width() : std::get<Prism>(part.body).depth;
    longest = std::max(longest, length);
    CHECK(length <= 1.3 + 1e-9);
  }
  CHECK(longest > 0.6);
  CHECK(has_note(cut, "Bars longer than the 1.3 m"));
  CHECK(!has_note(one, "Bars longer"));
  // Of the usual 6 m, legs of 9 m and more are two.
  CHECK(has_note(whole, "Bars longer than the 6 m"));
}

TEST_CASE("bar pieces: flat bars are as few equal pieces as their stock asks, whatever their measures are") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < (testing::thorough() ? 12 : 4); ++run) {
    PlateOptions options;
    options.supports.emplace();
    options.supports->ground = {{0.0, -random.between(6.0, 9.0)}};
    options.supports->braced_from = 0.5;
    options.supports->tube = random.between(50e-3, 90e-3);
    options.split.sheet = {0.7, 0.65};
    options.split.longest = 0.6;
    // Frames of wider ones are not cut from such a sheet in one.
    const ChannelMeasures channel{random.between(0.3, 0.55), 0.25, 4e-3};
    options.split.bar = 100.0;
    const WorkshopBuild whole = plates(chute(), options, channel);
    options.split.bar = random.between(0.35, 3.0);
    CAPTURE(run, channel.width, options.split.bar);
    const WorkshopBuild cut = plates(chute(), options, channel);
    std::size_t wanted = 0;
    double volume = 0.0;
    for (const ShopPart* const brace : named(whole, "brace")) {
      CHECK(brace->flat_bar == brace->bought_in);
      const double length = bounds(brace->pattern->region.outline).width();
      wanted += brace->quantity() * static_cast<std::size_t>(
                                        brace->flat_bar ? std::ceil(length / options.split.bar - 1e-9) : 1.0);
      volume += brace->volume * static_cast<double>(brace->quantity());
    }
    std::size_t pieces = 0;
    for (const ShopPart* const brace : named(cut, "brace")) {
      INFO(brace->name);
      CHECK(faults_of(brace->pattern->region).empty());
      if (brace->flat_bar) CHECK(bounds(brace->pattern->region.outline).width() <= options.split.bar + 1e-9);
      pieces += brace->quantity();
      volume -= brace->volume * static_cast<double>(brace->quantity());
    }
    CHECK(wanted > 0);
    CHECK(pieces == wanted);
    CHECK(std::fabs(volume) < 1e-12);
    CHECK(!has_note(cut, "Frames, flanges and stiffeners"));
    CHECK(cut.proof.bolted == whole.proof.bolted);
  }
}

TEST_CASE("bar pieces: flat bars are cut from no sheet, and lighter than the heaviest part") {
  PlateOptions options;
  options.supports.emplace();
  options.supports->ground = {{0.0, -9.0}};
  options.supports->braced_from = 0.5;
  options.split.sheet = {1.5, 1.2};
  options.split.longest = 0.6;
  const ChannelMeasures wide{1.0, 0.25, 4e-3};
  const auto by_sheet = [](const WorkshopBuild& build) {
    double most = 0.0;
    for (const ShopMeasurement& one : build.workshop.measured) {
      if (one.quantity == "part_sheet_share") most = std::max(most, one.in_units());
    }
    return most;
  };
  const WorkshopBuild whole = plates(chute(), options, wide);
  CHECK(bounds(part_of(whole, "brace").pattern->region.outline).width() > 1.5);
  CHECK(by_sheet(whole) <= 1.0);
  options.split.sheet = {6.0, 3.0};
  CHECK(!part_of(plates(chute(), options, wide), "brace").bought_in);
  // Too heavy in one, a brace is flat bar in pieces, whether a sheet takes it or not.
  options.split.longest = 0.3;
  options.flanges.wanted = false;
  options.split.bar = 100.0;
  const ChannelMeasures light{0.6, 0.05, 1e-3};
  const double one = part_of(plates(chute(), options, light), "brace").mass;
  options.split.heaviest = 0.95 * one;
  for (const Vec2 sheet : {Vec2{1.5, 1.2}, Vec2{0.7, 0.65}}) {
    options.split.sheet = sheet;
    const ShopPart brace = part_of(plates(chute(), options, light), "brace");
    CHECK(brace.flat_bar);
    CHECK(brace.mass < 0.6 * one);
  }
}

TEST_CASE("bar pieces: what is longer than a bar is refused where one piece is asked for") {
  PlateOptions options = with_angles(1.5);
  options.split.longest.reset();
  options.split.sheet = {12.0, 6.0};
  options.split.allowed = false;
  CHECK(refusal_of([&] {
          return plates(chute(), options, {2.0, 0.25, 4e-3});
        }).find("of bar|One piece is asked for, and bars are 1.5 m long.|bar: 3 m") != std::string::npos);
  options.split.bar = 0.0;
  CHECK(refusal(options).find("split.bar|split.bar: 0 mm is not positive") != std::string::npos);
}

TEST_CASE("bar pieces: random angles, pitches and bars make pieces that add up") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int run = 0; run < (testing::thorough() ? 6 : 2); ++run) {
    PlateOptions options = with_angles(random.between(0.5, 1.5));
    options.flanges.pitch = random.between(60e-3, 200e-3);
    options.round = RoundMake::mitred;
    options.bend.rule = FacetRule::segment_angle;
    options.bend.value = random.between(0.06, 0.12);
    if (random.integer(0, 1) == 0) options.flanges.slotted = FlangeSide::downstream;
    options.flanges.width = 75e-3;
    options.flanges.thickness = 8e-3;
    const double wide = random.between(0.6, 0.9);
    const section::Measures sections[] = {
        section::UChannel{WidthLaw(2.0 * wide), 0.3, 5e-3},
        section::Trapezoid{WidthLaw(2.0 * wide), 0.4, Angle::from_degrees(25.0), 5e-3},
        section::Pipe{wide, 4e-3}, section::HalfPipe{wide, random.between(0.0, 0.2), 4e-3}};
    const auto& section = sections[random.integer(0, 3)];
    CAPTURE(run, wide, section.index(), options.split.bar, options.flanges.pitch);
    const WorkshopBuild build = plates_of(chute(), section, options);
    const Bars cut = angles_of(build);
    CHECK(cut.longest <= options.split.bar + 1e-9);
    options.split.bar = 12.0;
    const Bars one = angles_of(plates_of(chute(), section, options));
    CHECK(cut.bolts == one.bolts);
    CHECK(cut.volume == Approx(one.volume).epsilon(1e-12));
  }
}

}  // namespace bar_pieces_test
