// Holes in lids, covers and rims, against their edges.

#include "glissade/parts/plates.hpp"

#include "parts/chute_plates.hpp"
#include "support/catch.hpp"

#include <algorithm>
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
