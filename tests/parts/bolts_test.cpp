#include "parts/shop/bolts.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <cmath>

using namespace glissade;

TEST_CASE("bolts: lengths reach through grip, both washers, nut and two threads, and no step farther") {
  for (const int size : bolt_sizes()) {
    const parts::Bolt& bolt = parts::bolt_of(size);
    const double threads = 0.3e-3 * size;
    for (double grip = 2e-3; grip < 60e-3; grip += 0.7e-3) {
      CAPTURE(size, grip);
      const double length = parts::bolt_length(bolt, grip);
      const double taken = grip + bolt.washer_height + bolt.washer_height + bolt.nut_height + threads;
      CHECK(length >= taken - 1e-9);
      CHECK(length < taken + 5e-3);
      CHECK(std::fabs(length / 5e-3 - std::nearbyint(length / 5e-3)) < 1e-9);
    }
  }
  // By hand, ISO 7089 and ISO 4032: 15 + 2 x 2.2 + 8.4 + 3 = 30.8 mm; with one washer it would be 30 mm.
  CHECK(parts::bolt_length(parts::bolt_of(10), 15e-3) == Approx(35e-3).epsilon(1e-12));
}

TEST_CASE("bolts: centres are even, at both ends, and no farther apart than the pitch") {
  const Vec2 from{0.1, -0.2};
  const Vec2 along{0.6, 0.8};
  for (const double length : {0.02, 0.149, 0.15, 0.1501, 0.9, 1.0}) {
    CAPTURE(length);
    const std::vector<Vec2> centres = parts::evenly(from, from + length * along, 0.15);
    REQUIRE(centres.size() >= 2);
    CHECK(centres.size() == 1 + static_cast<std::size_t>(std::ceil(length / 0.15 - 1e-9)));
    CHECK(norm(centres.front() - from) < 1e-15);
    CHECK(norm(centres.back() - from - length * along) < 1e-15);
    const double step = length / static_cast<double>(centres.size() - 1);
    for (std::size_t i = 1; i < centres.size(); ++i)
      CHECK(norm(centres[i] - centres[i - 1]) == Approx(step).epsilon(1e-12));
  }
  CHECK_THROWS_AS(parts::bolt_of(7), InputError);
}
