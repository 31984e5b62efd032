// Signed distances of points, segments and polygons from what a track keeps clear of.

#include "clearance/region.hpp"

#include "support/catch.hpp"
#include "support/mesh_clearance.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

using namespace glissade;
using clearance::Pass;
using clearance::Region;

namespace {

/// A beam, 1 to 2 along and 3 to 3.5 down.
const std::vector<Vec2> kBeam = {{1.0, 3.0}, {2.0, 3.0}, {2.0, 3.5}, {1.0, 3.5}};

double value(const Region& region, std::vector<Vec2> shape) {
  return region.nearest(shape).value;
}

}  // namespace

TEST_CASE("region: an area passed on either side counts from its outline, inside below zero") {
  const Region beam = Region::area(kBeam, Pass::either);
  CHECK(value(beam, {{0.0, 3.2}}) == 1.0);
  CHECK(value(beam, {{1.5, 4.0}}) == 0.5);
  CHECK(value(beam, {{0.7, 2.6}}) == Approx(0.5).epsilon(1e-14));
  CHECK(value(beam, {{1.5, 3.2}}) == Approx(-0.2).epsilon(1e-14));
  // A segment from side to side through the beam: none of its ends is in it, some of its points are.
  CHECK(value(beam, {{1.5, 2.0}, {1.5, 4.0}}) < -0.2);
  CHECK(value(beam, {{0.5, 2.0}, {0.5, 4.0}}) == 0.5);
  // A polygon around the beam.
  CHECK(value(beam, {{0.0, 0.0}, {5.0, 0.0}, {5.0, 9.0}, {0.0, 9.0}}) <= 0.0);
}

TEST_CASE("region: an area passed above forbids what lies below it, over its own runs only") {
  const Region beam = Region::area(kBeam, Pass::above);
  CHECK(value(beam, {{1.5, 2.0}}) == 1.0);
  CHECK(value(beam, {{1.5, 9.0}}) == Approx(-6.0));
  CHECK(value(beam, {{2.5, 9.0}}) == Approx(std::hypot(0.5, 5.5)));
  CHECK(value(beam, {{0.5, 2.0}, {0.5, 9.0}}) == 0.5);
  CHECK(value(beam, {{0.5, 8.0}, {1.25, 8.5}}) < -5.0);
  const Region under = Region::area(kBeam, Pass::below);
  CHECK(value(under, {{1.5, 4.0}}) == 0.5);
  CHECK(value(under, {{1.5, 1.0}, {1.6, 4.0}}) == Approx(-2.5));
}

TEST_CASE("region: the upper side of a shape that overhangs is taken run by run") {
  // A hook: a post from 0 to 1 with an arm to 3 at the top.
  const std::vector<Vec2> hook = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 1.0}, {1.0, 1.0}, {1.0, 4.0}, {0.0, 4.0}};
  CHECK(value(Region::area(hook, Pass::above), {{2.0, -1.0}}) == 1.0);
  const Region below = Region::area(hook, Pass::below);
  CHECK(value(below, {{2.0, 1.5}}) == 0.5);
  CHECK(value(below, {{0.5, 4.5}}) == 0.5);
  CHECK(value(below, {{0.5, 3.0}}) == Approx(-1.0));
  CHECK(below.jumps_within(0.9, 1.1));
  CHECK_FALSE(below.jumps_within(1.1, 2.9));
}

TEST_CASE("region: a line forbids what lies behind it, over its own runs only") {
  const Region ground = Region::line({{0.0, 2.0}, {4.0, 4.0}}, true);
  CHECK(value(ground, {{1.0, 1.5}}) == Approx(2.0 / std::sqrt(5.0)));
  CHECK(value(ground, {{-0.5, 1.0}}) == Approx(std::hypot(0.5, 1.0)));
  CHECK(value(ground, {{2.0, 4.0}}) == Approx(-2.0 / std::sqrt(5.0)));
  CHECK(value(ground, {{-1.0, 3.0}}) == Approx(std::hypot(1.0, 1.0)));
  CHECK(value(ground, {{2.0, 2.0}, {2.0, 4.0}}) == Approx(-2.0 / std::sqrt(5.0)));
  // A spike of the ground between the ends of a segment.
  const Region spike = Region::line({{0.0, 5.0}, {1.0, 5.0}, {1.5, 1.0}, {2.0, 5.0}, {3.0, 5.0}}, true);
  CHECK(value(spike, {{0.5, 2.0}, {2.5, 2.0}}) < 0.0);
}

TEST_CASE("region: a half-plane forbids what lies beyond its line") {
  const Region wall = Region::half_plane({3.0, 7.0}, {2.0, 0.0});
  CHECK(value(wall, {{1.0, 0.0}}) == 2.0);
  CHECK(value(wall, {{1.0, 0.0}, {4.5, -3.0}}) == -1.5);
}

TEST_CASE("region: distances of random segments from random outlines are those of brute force") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec2> outline;
    const int corners = random.integer(3, 40);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * 3.14159265358979 * k / corners;
      const double radius = random.between(0.3, 2.0);
      outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const Region region = Region::area(outline, Pass::either);
    const Vec2 a{random.between(-4.0, 4.0), random.between(-4.0, 4.0)};
    const Vec2 b{random.between(-4.0, 4.0), random.between(-4.0, 4.0)};
    const double expected = testing::mesh_distance({{a, b, b}}, outline, true);
    INFO("case " << i << ", distance " << expected);
    const clearance::Nearest nearest = region.nearest(std::vector<Vec2>{a, b});
    CHECK(std::max(nearest.value, 0.0) == Approx(expected).margin(1e-12));
    CHECK(testing::segment_distance(a, b, nearest.point, nearest.point) < 1e-12);
  }
}
