#include "parts/shop/bolts.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace glissade;

TEST_CASE(
    "bolts: lengths reach through grip, both washers, nut and two threads, and no nominal length farther") {
  // ISO 888, as ISO 4017 and ISO 10642 have them [mm].
  const std::vector<int> nominal = {12, 16, 20, 25, 30, 35, 40,  45,  50,
                                    55, 60, 65, 70, 80, 90, 100, 110, 120};
  for (const int size : bolt_sizes()) {
    const parts::Bolt& bolt = parts::bolt_of(size);
    const double threads = 0.3e-3 * size;
    for (double grip = 2e-3; grip < 60e-3; grip += 0.7e-3) {
      CAPTURE(size, grip);
      const double length = parts::bolt_length(bolt, grip);
      const double taken = grip + bolt.washer_height + bolt.washer_height + bolt.nut_height + threads;
      CHECK(length >= taken - 1e-9);
      const auto chosen = std::find_if(nominal.begin(), nominal.end(),
                                       [&](int one) { return std::fabs(1e-3 * one - length) < 1e-9; });
      REQUIRE(chosen != nominal.end());
      if (chosen != nominal.begin()) CHECK(1e-3 * *(chosen - 1) < taken);
    }
  }
  // By hand, ISO 7089 and ISO 4032: 15 + 2 x 2.2 + 8.4 + 3 = 30.8 mm; with one washer it would be 30 mm.
  CHECK(parts::bolt_length(parts::bolt_of(10), 15e-3) == Approx(35e-3).epsilon(1e-12));
  // There is no 15, and no 75 and 85: a lid of 5 mm in all with M6 takes 5 + 2 x 1.8 + 5.2 + 1.8 = 15.6 mm.
  CHECK(parts::bolt_length(parts::bolt_of(6), 4.4e-3) == Approx(16e-3).epsilon(1e-12));
  CHECK(parts::bolt_length(parts::bolt_of(10), 55e-3) == Approx(80e-3).epsilon(1e-12));
  CHECK(parts::bolt_length(parts::bolt_of(10), 160e-3) == Approx(180e-3).epsilon(1e-12));
}

TEST_CASE("bolts: countersunk heads are as high as ISO 10642 has them, up to M20") {
  for (const int size : bolt_sizes()) {
    CAPTURE(size);
    const parts::Bolt& bolt = parts::bolt_of(size);
    CHECK((bolt.head_height > 0.0) == (size <= 20));
    if (size > 20) continue;
    // Cones of 90 deg: half of what the largest theoretical head diameter, 2.24 d up to M12, exceeds the thread by.
    if (size <= 12) CHECK(bolt.head_height == Approx(0.62e-3 * size));
  }
  CHECK(parts::bolt_of(16).head_height == Approx(0.5 * (33.6e-3 - 16e-3)));
  CHECK(parts::bolt_of(20).head_height == Approx(0.5 * (40.32e-3 - 20e-3)));
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
