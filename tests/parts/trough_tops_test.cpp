// Rims and covers of mitred troughs. Every build proves that nothing clashes and that bolts meet their holes.

#include "glissade/core/number_text.hpp"
#include "glissade/parts/plates.hpp"

#include "parts/brep_faults.hpp"
#include "parts/chute_plates.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shortfalls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

using namespace glissade;
using namespace testing;

namespace {

PlateOptions covered_options() {
  PlateOptions options;
  options.round = RoundMake::mitred;
  options.rim.emplace();
  options.cover.emplace();
  options.bend = {FacetRule::segment_angle, 6.0 / 180.0 * std::numbers::pi, {}, {}};
  return options;
}

double length_of(const ShopPart& part) {
  return bounds(part.pattern->region.outline).width();
}

}  // namespace

TEST_CASE(
    "trough tops: covers lie trough by trough, off its mitres, bolted to both rims, within sheet and mass") {
  Random random = seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int covered = 0;
  for (int round = 0; round < 14; ++round) {
    const double width = random.between(0.3, 0.9);
    const section::HalfPipe half{width, random.integer(0, 2) == 0 ? 0.0 : random.between(0.05, 0.3),
                                 random.between(2e-3, 4e-3)};
    const ClothoidSpline track =
        random_track(random, {.smallest = 4.0, .largest = 8.0, .bends = 2, .crest = -0.15, .valley = 0.2});
    PlateOptions options = covered_options();
    options.flanges.wanted = random.integer(0, 2) != 0;
    if (random.integer(0, 1) == 0) options.stiffeners.emplace();
    if (random.integer(0, 1) == 0) options.lifting.emplace();
    if (random.integer(0, 1) == 0) options.split.heaviest = random.between(8.0, 30.0);
    options.cover->thickness = random.between(1e-3, 4e-3);
    options.cover->bolt = random.integer(0, 1) == 0 ? 6 : 8;
    CAPTURE(round, width, half.wall_height, options.flanges.wanted, options.split.heaviest);
    WorkshopBuild build;
    const std::string told = refusal_of([&] { build = plates_of(track, half, options); });
    INFO(told);
    CHECK((told.empty() || told.find("split") == 0));
    if (!told.empty()) continue;
    ++covered;
    // A row of holes at each side of every piece, the same ones in the rims.
    std::size_t holes = 0;
    double lengths = 0.0;
    for (const ShopPart* const cover : named(build, "cover")) {
      INFO(cover->name);
      CHECK(fault_of(*cover) == "");
      const PlaneRegion& region = cover->pattern->region;
      CHECK(bounds(region.outline).height() ==
            Approx(width + 2.0 * half.thickness + 2.0 * options.rim->width));
      for (const Circle& hole : region.holes) {
        const double end = std::min(hole.centre.x, length_of(*cover) - hole.centre.x);
        CHECK(end > 0.999 * options.shop.hole_edge_diameters * 2.0 * hole.radius);
      }
      if (options.split.heaviest) CHECK(cover->mass <= *options.split.heaviest);
      holes += cover->quantity() * region.holes.size();
      lengths += static_cast<double>(cover->quantity()) * length_of(*cover);
    }
    std::size_t in_rims = 0;
    double rims = 0.0;
    for (const ShopPart* const rim : named(build, "rim")) {
      in_rims += rim->quantity() * rim->pattern->region.holes.size();
      rims += 0.5 * static_cast<double>(rim->quantity()) * length_of(*rim);
    }
    CHECK(holes == in_rims);
    CHECK(holes > 0);
    CHECK(build.proof.bolted >= holes);
    // But for gaps, and troughs that are too short and told.
    CHECK(lengths < rims);
    const std::string open = shortfall_of(build.workshop, "cover: ");
    if (!open.empty()) {
      CHECK(open.find(" troughs stay open, trough") != std::string::npos);
      CHECK(open.find("|At their tops they are shorter than the ") != std::string::npos);
    } else
      CHECK(lengths > 0.95 * rims);
  }
  CHECK(covered > 8);
}

TEST_CASE("trough tops: covers that find no place are refused with what does") {
  const ClothoidSpline track(Angle::from_degrees(50.0), {{3.0, 0.25, 0.25}});
  const section::HalfPipe half{0.4, 0.1, 3e-3};
  PlateOptions options = covered_options();
  const auto refused = [&] { return refusal_of([&] { return plates_of(track, half, options); }); };
  CHECK(refused() == "");
  options.rim.reset();
  CHECK(refused() == "cover|cover: it is bolted to a rim, and there is none||rim: {width: 40 mm}\n");
  options.rim.emplace();
  options.bend.value = 0.3 / 180.0 * std::numbers::pi;
  options.flanges.wanted = false;
  CHECK(refused() ==
        "cover|cover: every trough is shorter at its top than its bolts take|They take 40 mm.|longer troughs "
        "(bend), a smaller bolt, round: staves, or no cover\n");
  options.round = RoundMake::staves;
  CHECK(refused() == "");
  options = covered_options();
  options.rim->width = 1.4;
  const std::string wide = refused();
  CHECK(wide.find("cover|cover: a piece takes ") == 0);
  CHECK(wide.find("|No shorter piece does, and the sheet is 3 m x 1.5 m.|sheet: [") != std::string::npos);
  options.split.sheet = {4.0, 1.5};
  CHECK(refused() == "");
  // Of a whole pipe.
  CHECK(refusal_of([&] {
          return plates_of(track, section::Pipe{0.4, 3e-3}, covered_options());
        }).find("cover|cover: a closed section has no tops that it could lie on||no cover") !=
        std::string::npos);
}
