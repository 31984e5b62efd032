// Holes in lids, covers and rims, against their edges.

#include "glissade/parts/plates.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

using namespace glissade;
using namespace testing;

TEST_CASE("lids and covers keep bolts of any size as far off their edges as is asked for") {
  const auto least_edge = [](const WorkshopBuild& build, const char* word) {
    double least = 1.0;
    for (const ShopPart* const part : named(build, word)) {
      const PlaneBox box = bounds(part->pattern->region.outline);
      for (const Circle& hole : part->pattern->region.holes) {
        const Vec2 low = hole.centre - box.low;
        const Vec2 high = box.high - hole.centre;
        least = std::min({least, low.x, low.y, high.x, high.y});
      }
    }
    return least;
  };
  PlateOptions options;
  options.rim.emplace();
  options.cover.emplace();
  for (const int bolt : bolt_sizes()) {
    INFO("M" << bolt);
    const double edge = 1.2 * clearance_hole(bolt, HoleFit::coarse);
    options.rim->width = std::max(40e-3, 2.0 * edge);
    options.cover->bolt = bolt;
    options.inspection = {{4.5, 0.2, 0.1, bolt}};
    const WorkshopBuild build = plates(chute(), options);
    CHECK(least_edge(build, "lid") > edge - 1e-9);
    CHECK(least_edge(build, "cover") > edge - 1e-9);
    CHECK(least_edge(build, "rim") > edge - 1e-9);
    // The usual lap takes bolts up to M10.
    if (bolt <= 10) CHECK(least_edge(build, "lid") == Approx(15e-3));
    options.rim->width = 2.0 * edge - 1e-4;
    CHECK(refusal(options).find("cover.bolt|bolt: the middle of holes for M" + std::to_string(bolt) +
                                " is ") == 0);
  }
}

TEST_CASE("openings whose lids would lie upon one another are refused, with a place that does") {
  PlateOptions options;
  for (const double at : {4.45, 4.6}) {
    INFO(at);
    options.inspection = {{4.5, 0.2, 0.12, 8}, {at, 0.15, 0.1, 10}};
    const std::string told = refusal(options);
    CHECK(told.find("inspection|at: openings at 4.5 m and ") == 0);
    CHECK(told.find(" are too close|With their lids they take ") != std::string::npos);
    const std::size_t hint = told.find("|at: ", told.find("With their lids"));
    REQUIRE(hint != std::string::npos);
    options.inspection.back().at = std::stod(told.substr(hint + 5));
    CHECK(refusal(options) == "");
  }
}

TEST_CASE("lugs across the track stand off the legs of angles along it") {
  PlateOptions options;
  options.split.sheet = {2.5, 1.25};
  options.flanges.section = FlangeSection::angle;
  options.flanges.thickness = 5e-3;
  options.flanges.as_told = true;
  options.corners.kind = CornerJoint::lap;
  options.lifting.emplace();
  const CoulombBrachistochrone track({8.549, 2.742}, Friction::from_angle(Angle::from_degrees(10.9)));
  const section::Trapezoid trough{WidthLaw(0.67), 0.786, Angle::from_degrees(14.2), 6e-3};
  CHECK_NOTHROW(plates_of(track, trough, options));
}
