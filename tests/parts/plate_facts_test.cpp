// What rules of the shop are told of holes, on patterns whose distances are known by hand.

#include "parts/plates/plate_facts.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/slot.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/chute_plates.hpp"
#include "parts/plates/plate_joints.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shop_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace glissade;

namespace {

constexpr double kThickness = 0.004;

/// 400 x 300 mm.
ShopPart sheet(const std::vector<Circle>& holes, const std::vector<ArcPath>& cutouts = {},
               const std::vector<BendLine>& bends = {}) {
  const PlaneRegion region{rectangle({0.0, 0.0}, {0.4, 0.3}), cutouts, holes};
  ShopPart part = testing::shop_part(1, "plate", Prism{region, kThickness});
  part.pattern = FlatPattern{region, bends, {}, {}, {}, 0.0};
  return part;
}

/// The least of a quantity, in its units; infinite where there is none.
double least(const ShopPart& part, std::string_view quantity) {
  Workshop workshop;
  workshop.parts = {part};
  parts::measure_plates(PlateOptions(), workshop);
  double value = std::numeric_limits<double>::infinity();
  for (const ShopMeasurement& one : workshop.measured) {
    if (one.quantity == quantity) value = std::min(value, one.in_units());
  }
  return value;
}

}  // namespace

TEST_CASE("plate facts: holes by their thickness, from edges and from each other") {
  // Of 10 and 20 mm, 60 mm apart, 30 mm and 40 mm from the nearest edge.
  const ShopPart part = sheet({{{0.10, 0.03}, 5e-3}, {{0.16, 0.03}, 10e-3}, {{0.04, 0.2}, 6e-3}});
  CHECK(least(part, "hole_thicknesses") == Approx(10.0 / 4.0).epsilon(1e-12));
  CHECK(least(part, "hole_edge_diameters") == Approx(30.0 / 20.0).epsilon(1e-12));
  CHECK(least(part, "hole_pitch_diameters") == Approx(60.0 / 20.0).epsilon(1e-12));
  CHECK(least(part, "web_thicknesses") == Approx((30.0 - 10.0) / 4.0).epsilon(1e-12));
  // Between the two: 60 - 5 - 10.
  const ShopPart near = sheet({{{0.10, 0.1}, 5e-3}, {{0.12, 0.1}, 10e-3}});
  CHECK(least(near, "web_thicknesses") == Approx((20.0 - 5.0 - 10.0) / 4.0).epsilon(1e-12));
}

TEST_CASE("plate facts: holes keep off what is cut out beside them") {
  const Circle hole{{0.10, 0.1}, 5e-3};
  const ShopPart opening = sheet({hole}, {rectangle({0.12, 0.05}, {0.3, 0.2})});
  CHECK(least(opening, "hole_edge_diameters") == Approx(20.0 / 10.0).epsilon(1e-12));
  CHECK(least(opening, "web_thicknesses") == Approx((20.0 - 5.0) / 4.0).epsilon(1e-12));
  // A slot is no edge; a web stands between them all the same.
  const ShopPart slot = sheet({hole}, {path_of(Slot{{0.15, 0.1}, {0.02, 0.0}, 7e-3})});
  CHECK(least(slot, "hole_edge_diameters") == Approx(100.0 / 10.0).epsilon(1e-12));
  CHECK(least(slot, "web_thicknesses") == Approx((50.0 - 20.0 - 7.0 - 5.0) / 4.0).epsilon(1e-12));
}

TEST_CASE("plate facts: holes are told from where a bend begins, not from its middle") {
  // 90 deg about 6 mm: half of (6 + 4 / 2) pi / 2 to either side of its line.
  const BendLine bend{{0.2, 0.0}, {0.2, 0.3}, Angle::from_degrees(90.0), 6e-3, true};
  const ShopPart part = sheet({{{0.15, 0.1}, 8e-3}}, {}, {bend});
  const double half = 0.5 * 8.0 * 0.5 * std::numbers::pi;
  CHECK(least(part, "hole_bend_thicknesses") == Approx((50.0 - 8.0 - half) / 4.0).epsilon(1e-12));
}

TEST_CASE("plate facts: a part that fits the sheet when it is turned fits it") {
  // Drawn at 30 deg, 2.9 by 0.3 m takes 2.66 by 1.71 m: the sheet is 3 by 1.5 m.
  const auto share = [](double angle, double length) {
    Workshop workshop;
    workshop.parts = {sheet({})};
    ArcPath& outline = workshop.parts[0].pattern->region.outline;
    outline = moved(rectangle({0.0, 0.0}, {length, 0.3}), PlaneMotion::turn(angle));
    parts::measure_plates(PlateOptions(), workshop);
    double most = 0.0;
    for (const ShopMeasurement& one : workshop.measured) {
      if (one.quantity == "part_sheet_share") most = std::max(most, one.in_units());
    }
    CHECK(parts::excess(PlateOptions().split, workshop.parts[0]).has_value() == (length > 2.99));
    return most;
  };
  for (const double angle : {0.0, std::numbers::pi / 6.0, std::numbers::pi / 2.0}) {
    CAPTURE(angle);
    CHECK(share(angle, 2.9) == Approx(2.9 / 3.0).epsilon(1e-4));
    CHECK(share(angle, 3.1) > 1.0);
  }
}

TEST_CASE("plate facts: a bar is as wide as it is, however it is drawn") {
  for (const double angle : {0.0, 0.1, std::numbers::pi / 4.0, 1.2}) {
    CAPTURE(angle);
    ShopPart part = sheet({});
    part.pattern->region.outline = moved(rectangle({0.0, 0.0}, {0.4, 0.01}), PlaneMotion::turn(angle));
    CHECK(least(part, "part_width") == Approx(10e-3).epsilon(1e-9));
  }
}

namespace {

/// The least and the greatest of a quantity.
std::array<double, 2> ends_of(const Workshop& workshop, std::string_view quantity) {
  std::array<double, 2> ends{std::numeric_limits<double>::infinity(), 0.0};
  for (const ShopMeasurement& one : workshop.measured) {
    if (one.quantity != quantity) continue;
    ends = {std::min(ends[0], one.in_units()), std::max(ends[1], one.in_units())};
  }
  return ends;
}

/// What is told of holes at those places of a bar along x.
std::array<double, 2> pitch_of(const std::vector<double>& places, bool closed = false) {
  std::vector<Circle> holes;
  for (const double x : places) holes.push_back({{x, 0.01}, 5e-3});
  const ShopPart frame = sheet(holes);
  const ArcPath line{{{{0.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0}}, false};
  Workshop workshop;
  parts::measure_bolt_row(parts::bolts_in_order(frame, line), closed, workshop);
  return ends_of(workshop, "bolt_pitch");
}

/// Bolts of one frame in the plane of its joint: across, and up in that plane.
struct Joint {
  std::vector<Vec2> bolts;
  void add(const ShopPart& part) {
    for (const Frame& place : part.places) {
      // The way along the track, whichever way the frame faces.
      const double sign = place.z.x < 0.0 ? -1.0 : 1.0;
      const auto see = [&](Vec2 middle) {
        const Vec3 at = place.to_space({middle.x, middle.y, 0.0});
        const Vec2 bolt{at.y, sign * (place.z.x * at.z - place.z.z * at.x)};
        // Along a straight track the frames of all units have theirs behind one another.
        const bool known =
            std::any_of(bolts.begin(), bolts.end(), [&](Vec2 other) { return norm(other - bolt) < 1e-9; });
        if (!known) bolts.push_back(bolt);
      };
      for (const Circle& hole : part.pattern->region.holes) see(hole.centre);
      for (const ArcPath& cutout : part.pattern->region.cutouts) {
        if (const auto slot = as_slot(cutout)) see(slot->middle);
      }
    }
  }
  /// By the angle about the middle of a closed frame, or about a place above an open one.
  [[nodiscard]] std::array<double, 2> gaps(bool closed) const {
    Vec2 low = bolts.front();
    Vec2 high = low;
    for (const Vec2 at : bolts) {
      low = {std::min(low.x, at.x), std::min(low.y, at.y)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
    const Vec2 eye{0.5 * (low.x + high.x), closed ? 0.5 * (low.y + high.y) : high.y + 1e-3};
    std::vector<Vec2> row = bolts;
    // Open frames have no bolt straight above the eye, where angles begin anew.
    std::sort(row.begin(), row.end(), [&](Vec2 a, Vec2 b) {
      return std::atan2(a.x - eye.x, eye.y - a.y) < std::atan2(b.x - eye.x, eye.y - b.y);
    });
    std::array<double, 2> ends{std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t i = 0; i + (closed ? 0 : 1) < row.size(); ++i) {
      const double gap = norm(row[(i + 1) % row.size()] - row[i]);
      ends = {std::min(ends[0], gap), std::max(ends[1], gap)};
    }
    return ends;
  }
};

bool is_of_frame(const ShopPart& part) {
  return part.name.find("frame") != std::string::npos || part.name.find("flange") != std::string::npos;
}

/// Of the frames at both ends of units.
std::array<double, 2> by_hand(const WorkshopBuild& build, bool closed) {
  std::array<Joint, 2> joints;
  for (const ShopPart& part : build.workshop.parts) {
    if (!is_of_frame(part)) continue;
    const bool second =
        part.name.find("_loose") != std::string::npos || part.name.find("_slotted") != std::string::npos;
    joints.at(second ? 1 : 0).add(part);
  }
  std::array<double, 2> ends{std::numeric_limits<double>::infinity(), 0.0};
  for (const Joint& joint : joints) {
    if (joint.bolts.size() < 2) continue;
    const auto gaps = joint.gaps(closed);
    ends = {std::min(ends[0], gaps[0]), std::max(ends[1], gaps[1])};
  }
  return ends;
}

PlateOptions random_flanges(testing::Random& random) {
  PlateOptions options;
  options.flanges.as_told = true;
  options.flanges.pitch = random.between(0.06, 0.6);
  if (random.integer(0, 2) == 0) {
    options.flanges.section = FlangeSection::angle;
    options.flanges.width = 60e-3;
  }
  if (random.integer(0, 3) == 0) {
    options.flanges.slotted = FlangeSide::downstream;
    options.flanges.slot = 14e-3;
  }
  // Pieces of frames: the row goes on over cuts.
  if (random.integer(0, 2) == 0) options.split.frames = random.integer(2, 3);
  options.split.longest = 3.0;
  return options;
}

struct RandomFrames {
  WorkshopBuild build;
  bool closed = false;
};

RandomFrames random_frames(testing::Random& random) {
  const ClothoidSpline track(Angle::from_degrees(40.0), {{1.5, 0.0, 0.0}});
  PlateOptions options = random_flanges(random);
  switch (random.integer(0, 3)) {
    case 0: {
      const double size = random.between(0.3, 1.1);
      options.round = random.integer(0, 1) == 0 ? RoundMake::mitred : RoundMake::staves;
      options.stave_tolerance = 20e-3;
      return {testing::plates_of(track, section::Pipe{size, 4e-3}, options), true};
    }
    case 1:
      return {testing::plates_of(track, testing::v_channel(), options), false};
    default: {
      const double walls = random.integer(0, 3) == 0 ? 0.0 : random.between(0.1, 0.6);
      return {testing::plates(track, options, {random.between(0.2, 1.3), walls, 4e-3}), false};
    }
  }
}

}  // namespace

TEST_CASE("plate facts: bolts of a row are told by its widest and its least gap, not by each one's nearest") {
  // Each has a near neighbour, and 300 mm are clamped by none.
  const auto pairs = pitch_of({0.34, 0.04, 0.0, 0.38});
  CHECK(pairs[0] == Approx(0.04).epsilon(1e-12));
  CHECK(pairs[1] == Approx(0.30).epsilon(1e-12));
  // All round, the last is next to the first.
  CHECK(pitch_of({0.0, 0.1, 0.2}, true)[1] == Approx(0.2).epsilon(1e-12));
  CHECK(pitch_of({0.1})[1] == 0.0);
  CHECK(pitch_of({})[1] == 0.0);
}

TEST_CASE(
    "plate facts: of a frame the widest gap between bolts is told, over corners and cuts, of any section") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int made = 0;
  int hidden = 0;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    std::optional<RandomFrames> frames;
    try {
      frames = random_frames(random);
    } catch (const InputError&) {
      continue;  // no shop makes it
    }
    const auto told = ends_of(frames->build.workshop, "bolt_pitch");
    const auto measured = by_hand(frames->build, frames->closed);
    if (measured[1] == 0.0) continue;
    ++made;
    CHECK(told[0] == Approx(measured[0]).epsilon(1e-9));
    CHECK(told[1] == Approx(measured[1]).epsilon(1e-9));
    hidden += measured[1] > 1.5 * measured[0] ? 1 : 0;
  }
  CHECK(made >= 15);
  CHECK(hidden >= 3);
}
