// What rules of the shop are told of holes, on patterns whose distances are known by hand.

#include "parts/plates/plate_facts.hpp"

#include "glissade/core/slot.hpp"

#include "parts/plates/plate_joints.hpp"
#include "support/catch.hpp"
#include "support/shop_parts.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string_view>

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
