// Flanges of which one side of a joint has slots.

#include "glissade/core/slot.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/bolt_faults.hpp"
#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "parts/refusals.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace slotted_flanges_test {

namespace {

using namespace glissade;
using namespace testing;

PlateOptions slotted(FlangeSide side) {
  PlateOptions options;
  options.flanges.as_told = true;
  options.flanges.slotted = side;
  options.split.longest = 2.5;
  return options;
}

bool is_frame(const ShopPart& part) {
  return part.name.find("end_frame") == 0 || part.name.find("_flange") != std::string::npos;
}

std::vector<Slot> slots_of(const PlaneRegion& region) {
  std::vector<Slot> slots;
  for (const ArcPath& cutout : region.cutouts) {
    if (const auto slot = as_slot(cutout)) slots.push_back(*slot);
  }
  return slots;
}

/// A chute that is made quickly.
std::string refused(const PlateOptions& options, const ChannelMeasures& channel = kChannel) {
  const ClothoidSpline track(Angle::from_degrees(40.0), {{1.5, 0.0, 0.0}});
  return refusal_of([&] { return plates(track, options, channel); });
}

std::size_t bought(const WorkshopBuild& build, const std::string& name) {
  std::size_t count = 0;
  for (const BoughtInItem& item : build.workshop.items)
    count += item.name.find(name) == 0 ? item.quantity : 0;
  return count;
}

double least_measured(const WorkshopBuild& build, const std::string& quantity) {
  double least = 1e300;
  for (const ShopMeasurement& one : build.workshop.measured) {
    if (one.quantity == quantity) least = std::min(least, one.in_units());
  }
  return least;
}

std::vector<section::Measures> sections(double width, double t) {
  return {section::Measures(section::Trapezoid{WidthLaw(width), 0.25, Angle::from_degrees(35.0), t}),
          section::Measures(section::UChannel{WidthLaw(width), 0.25, t}),
          section::Measures(section::HalfPipe{width, 0.0, t}),
          section::Measures(section::HalfPipe{width, 0.1, t}),
          section::Measures(section::Pipe{width, t}),
          section::Measures(v_channel()),
          section::Measures(section::Slab{WidthLaw(width), t, 0.0, 0.0})};
}

/// A slotted build against the same with round holes: slots about the same middles, as much less plate as they have area.
void compare(const WorkshopBuild& round, const WorkshopBuild& build) {
  const auto volume = [](const WorkshopBuild& one, bool with) {
    double sum = 0.0;
    for (const ShopPart& part : one.workshop.parts) {
      if (is_frame(part) == with) sum += part.volume * static_cast<double>(part.quantity());
    }
    return sum;
  };
  CHECK(std::fabs(volume(round, false) / volume(build, false) - 1.0) < 1e-12);
  double more = 0.0;
  for (const ShopPart& part : build.workshop.parts) {
    if (!is_frame(part)) continue;
    const PlaneRegion& region = part.pattern->region;
    CHECK(faults_of(region).empty());
    if (!region.cutouts.empty() && as_slot(region.cutouts.front())) CHECK(fault_of(part).empty());
    const std::vector<Slot> slots = slots_of(region);
    CHECK(slots.empty() == (part.name.find("_slotted") == std::string::npos));
    CHECK(slots.empty() != region.holes.empty());
    for (const Slot& slot : slots) {
      CHECK(slot.reach.x == 0.0);  // upright
      more += 4.0 * slot.radius * norm(slot.reach) * part.thickness * static_cast<double>(part.quantity());
    }
  }
  CHECK(more > 0.0);
  CHECK(std::fabs((volume(round, true) - volume(build, true)) / more - 1.0) < 1e-9);
}

}  // namespace

TEST_CASE(
    "slotted flanges: every section has slots on one side of its joints, about the axes of the other side's "
    "holes") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const std::vector<section::Measures> all = sections(random.between(0.3, 0.6), random.between(2e-3, 5e-3));
  for (std::size_t k = 0; k < 2 * all.size(); ++k) {
    const section::Measures& measures = all[k / 2];
    const FlangeSide side = k % 2 == 0 ? FlangeSide::downstream : FlangeSide::upstream;
    PlateOptions options = slotted(side);
    if (k % 3 == 0) options.round = RoundMake::staves;
    const ClothoidSpline track =
        random_track(random, {.smallest = 5.0, .largest = 8.0, .bends = 2, .crest = -0.3, .valley = 0.6});
    INFO("kind " << measures.index() << ", side " << (k % 2));
    const WorkshopBuild build = plates_of(track, measures, options);  // throws where holes do not meet
    CHECK(build.proof.bolted == bought(build, "bolt M10"));
    CHECK(bought(build, "large washer M10") == bought(build, "bolt M10"));
    CHECK(bought(build, "washer M10") == bought(build, "bolt M10"));
    CHECK(least_measured(build, "slot_edge_diameters") > 1.5 - 1e-9);
    CHECK(least_measured(build, "web_thicknesses") > 1.0);
    PlateOptions plain = options;
    plain.flanges.slotted.reset();
    if (build.joints.size() < 3) continue;
    // Coarse holes may let a unit up or down by less than slots do.
    CHECK(std::fabs(build.ride.joint_play - plates_of(track, measures, plain).ride.joint_play - 6.5e-3) <
          1e-12);
  }
}

TEST_CASE("slotted flanges: what they have less of than those with round holes is their slots") {
  for (const FlangeSide side : {FlangeSide::downstream, FlangeSide::upstream}) {
    for (const double height : {0.25, 0.0}) {
      PlateOptions options = slotted(side);
      const ChannelMeasures channel{0.4, height, 4e-3};
      PlateOptions round = options;
      round.flanges.slotted.reset();
      const WorkshopBuild build = plates(chute(), options, channel);
      // Upstream it is the other frame whose round holes are coarse: medium ones are as much smaller there.
      if (side == FlangeSide::downstream) compare(plates(chute(), round, channel), build);
      const ShopPart& before =
          part_of(build, side == FlangeSide::upstream ? "end_frame_slotted" : "end_frame");
      REQUIRE(before.quantity() == build.joints.size() - 1);
      CHECK(slots_of(before.pattern->region).empty() == (side == FlangeSide::downstream));
    }
  }
  const PlateOptions options = slotted(FlangeSide::downstream);
  PlateOptions round = options;
  round.flanges.slotted.reset();
  const section::Pipe pipe{0.4, 3e-3};
  compare(plates_of(chute(), pipe, round), plates_of(chute(), pipe, options));
}

TEST_CASE("slotted flanges: frames larger than the sheet are cut between their slots") {
  PlateOptions options = slotted(FlangeSide::downstream);
  options.split.sheet = {2.0, 0.45};
  options.split.longest = 1.0;
  const WorkshopBuild build = plates(chute(), options, {0.8, 0.2, 4e-3});
  std::size_t slots = 0;
  std::size_t holes = 0;
  for (const ShopPart& part : build.workshop.parts) {
    if (!is_frame(part)) continue;
    CHECK(std::min(bounds(part.pattern->region.outline).width(),
                   bounds(part.pattern->region.outline).height()) < 0.45);
    CHECK(faults_of(part.pattern->region).empty());
    slots += slots_of(part.pattern->region).size() * part.quantity();
    holes += part.pattern->region.holes.size() * part.quantity();
  }
  CHECK(slots == holes);
  CHECK(slots > 20);
}

TEST_CASE(
    "slotted flanges: a unit may be raised by the reach of the slots, no farther, and not moved aside") {
  const WorkshopBuild build = plates(chute(), slotted(FlangeSide::downstream));
  const double reach = 6.5e-3;  // of slots of 25 mm, 12 mm wide
  const auto moved = [&](Vec3 by) {
    Workshop workshop = build.workshop;
    for (ShopPart& part : workshop.parts) {
      if (part.name != "end_frame_slotted") continue;
      for (Frame& place : part.places) place.origin = place.origin + by.x * place.x + by.y * place.y;
    }
    return bolt_fault(workshop);
  };
  CHECK(moved({}).empty());
  for (const double sign : {1.0, -1.0}) {
    CHECK(moved({0.0, sign * 0.99 * reach, 0.0}).empty());
    CHECK(moved({0.0, sign * 1.02 * reach, 0.0}).find("off the axis of that in") != std::string::npos);
    CHECK(moved({sign * 0.1e-3, 0.0, 0.0}).find("off the axis of that in") != std::string::npos);
  }
}

TEST_CASE("slotted flanges: what does not fit is told with a length, width or pitch that does") {
  PlateOptions options = slotted(FlangeSide::upstream);
  options.flanges.bolt = 12;
  CHECK(
      refused(options) ==
      "flanges.slotted|slotted: ends of slots of 30 mm for M12 are 17.2 mm from the edge of a flange of 50 "
      "mm|Middles of their half circles are at least 21.75 mm from it (EN 1993-1-8).|slot: 21 mm, or width: "
      "59 mm, or a smaller bolt\n");
  options.flanges.slot = 21e-3;
  CHECK(refused(options).empty());
  options.flanges.slot = 22e-3;
  CHECK(refused(options).find("flanges.slot|slotted: ends of slots of 22 mm") == 0);
  options.flanges.slot.reset();
  options.flanges.width = 59e-3;
  CHECK(refused(options).empty());
  options.flanges.slot = 14e-3;
  CHECK(refused(options) ==
        "flanges.slot|slot: 14 mm is no longer than it is wide for M12|Slots are as wide as coarse holes, "
        "14.5 mm, and at least 1 mm longer.|slot: 30 mm\n");
  PlateOptions none = slotted(FlangeSide::upstream);
  none.flanges.slotted.reset();
  none.flanges.slot = 25e-3;
  CHECK(refused(none) ==
        "flanges.slot|slot: 25 mm, but no flange is slotted||slotted: downstream, or no slot\n");
}

TEST_CASE("slotted flanges: too close a pitch is refused, and each way out is the least that builds") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t tried = 0;
  for (int run = 0; run < 24; ++run) {
    PlateOptions options = slotted(FlangeSide::downstream);
    options.flanges.pitch = random.between(29e-3, 60e-3);
    const ChannelMeasures channel{random.between(0.3, 0.6), random.between(0.15, 0.3), 4e-3};
    const auto told = [&](const FlangeOptions& flanges) {
      PlateOptions with = options;
      with.flanges = flanges;
      return refused(with, channel);
    };
    const std::string text = told(options.flanges);
    if (text.empty()) continue;
    ++tried;
    INFO("run " << run << ": " << text);
    REQUIRE(text.find("flanges.pitch|pitch: slots of 25 mm stand ") == 0);
    const auto number = [&](const std::string& key) {
      const std::size_t at = text.rfind(key);
      return at == std::string::npos ? -1.0 : 1e-3 * std::stod(text.substr(at + key.size()));
    };
    const double pitch = number("|pitch: ");
    REQUIRE(pitch > options.flanges.pitch);
    FlangeOptions flanges = options.flanges;
    flanges.pitch = pitch;
    CHECK(told(flanges).empty());
    flanges.pitch = pitch - 0.6e-3;
    CHECK((flanges.pitch < options.flanges.pitch || !told(flanges).empty()));
    const double slot = number(", slot: ");
    if (slot < 0.0) continue;
    flanges = options.flanges;
    flanges.slot = slot;
    CHECK(told(flanges).empty());
    flanges.slot = slot + 0.6e-3;
    CHECK_FALSE(told(flanges).empty());
  }
  CHECK(tried > 3);
}

TEST_CASE("flanges: a pitch too close for its bolts is refused with one that builds and keeps the rule") {
  PlateOptions usual;
  usual.flanges.pitch = 20e-3;
  CHECK(refused(usual) ==
        "flanges.pitch|pitch: 20 mm is too close for M10|Middles of holes of 12 mm are at least 28.8 mm "
        "apart (EN "
        "1993-1-8).|pitch: 31 mm, or a smaller bolt\n");
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const ClothoidSpline track(Angle::from_degrees(40.0), {{1.5, 0.0, 0.0}});
  std::size_t spread = 0;
  for (int run = 0; run < 80 || (run < 400 && spread == 0); ++run) {
    const auto all = sections(random.between(0.3, 0.7), 4e-3);
    const section::Measures measures = all[static_cast<std::size_t>(random.integer(0, 6))];
    PlateOptions options;
    options.flanges.as_told = true;
    options.flanges.bolt = std::array{6, 8, 10, 12}[static_cast<std::size_t>(random.integer(0, 3))];
    options.flanges.width = 60e-3;
    options.flanges.pitch = random.between(10e-3, 60e-3);
    if (random.integer(0, 2) == 0) {
      options.flanges.section = FlangeSection::angle;
      options.flanges.thickness = 6e-3;
    }
    if (random.integer(0, 2) == 0) options.round = RoundMake::staves;
    const auto told = [&](double pitch) {
      PlateOptions with = options;
      with.flanges.pitch = pitch;
      return refusal_of([&] { return plates_of(track, measures, with); });
    };
    const std::string text = told(options.flanges.pitch);
    INFO("run " << run << ", section " << measures.index() << ", pitch " << options.flanges.pitch << ": "
                << text);
    PlateOptions advised = options;
    if (!text.empty()) {
      if (text.find("flanges.section|") == 0) continue;  // sides too short for angles
      REQUIRE(text.find("flanges.pitch|") == 0);
      REQUIRE(text.find("|pitch: ") != std::string::npos);
      if (text.find(" stand ") != std::string::npos) ++spread;
      advised.flanges.pitch = 1e-3 * std::stod(text.substr(text.rfind("|pitch: ") + 8));
      CHECK(advised.flanges.pitch > options.flanges.pitch);
      const double less = advised.flanges.pitch - 0.5e-3;
      CHECK((less < options.flanges.pitch || !told(less).empty()));
    }
    CHECK(least_measured(plates_of(track, measures, advised), "hole_pitch_diameters") >= 2.4 - 1e-6);
  }
  CHECK(spread > 0);
}

}  // namespace slotted_flanges_test
