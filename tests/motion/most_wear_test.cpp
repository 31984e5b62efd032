#include "glissade/motion/laws/most_wear.hpp"

#include "glissade/core/error.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "tracks.hpp"

#include <algorithm>
#include <memory>
#include <optional>

namespace most_wear_test {

using namespace glissade;
using testing::Random;
using testing::track;

namespace {

Body stream(double ratio, double entry_speed) {
  Body body;
  body.law = std::make_shared<const BulkStream>(StreamShape{28.0, 1600.0, ratio, 0.4, std::nullopt});
  body.entry_speed = entry_speed;
  return body;
}

/// mu N at stations of a ride, without a search for what lies between them.
double peak_of(const CenterlinePtr& centerline, Body body, double mu) {
  body.friction = Friction::from_coefficient(mu);
  const Motion motion(centerline, body, kDefaultGravity);
  double peak = 0.0;
  for (int i = 0; i <= 400; ++i)
    peak = std::max(peak, mu * motion.at(motion.distance() * (i / 400.0)).normal_load);
  return peak * 28.0 / 0.4;
}

}  // namespace

TEST_CASE("a stream wears a valley most at a friction inside the range, as a scan of it has it") {
  // 6 m at 48 deg, then a bend of 1 m: at 35 deg a quarter more than at 20 deg.
  const CenterlinePtr steep = track(48.0 * 0.017453292519943295, {{6.0, 0.0, 0.0}, {0.48, 1.0, 1.0}});
  const Body body = stream(0.0, 3.0);
  const Friction low = Friction::from_coefficient(0.14);
  const Friction high = Friction::from_coefficient(0.96);
  const auto most = friction_of_most_wear(steep, body, kDefaultGravity, low, high);
  REQUIRE(most);
  const double peak = peak_of(steep, body, most->coefficient());
  CHECK(peak > 1.2 * peak_of(steep, body, 0.364));
  Random random = testing::seeded_random();
  int inside = 0;
  for (int i = 0; i < 20; ++i) {
    const CenterlinePtr drawn =
        track(random.between(0.6, 1.1),
              {{random.between(1.0, 8.0), 0.0, 0.0},
               {random.between(0.2, 0.6), random.between(0.0, 1.0), random.between(0.2, 1.0)}});
    const Body of_drawn = stream(random.between(0.0, 0.5), random.between(1.0, 4.0));
    const double from = random.between(0.05, 0.3);
    const double to = random.between(0.4, 1.0);
    const auto found = friction_of_most_wear(
        drawn, of_drawn, kDefaultGravity, Friction::from_coefficient(from), Friction::from_coefficient(to));
    const double at_ends = std::max(peak_of(drawn, of_drawn, from), peak_of(drawn, of_drawn, to));
    const double told = found ? peak_of(drawn, of_drawn, found->coefficient()) : at_ends;
    inside += found ? 1 : 0;
    CAPTURE(i, from, to, found ? found->coefficient() : 0.0);
    for (int k = 0; k <= 60; ++k)
      CHECK(peak_of(drawn, of_drawn, from + (to - from) * k / 60.0) <= told * (1.0 + 1e-4));
    if (found) {
      CHECK(from < found->coefficient());
      CHECK(found->coefficient() < to);
      CHECK(told > at_ends);
    }
  }
  CHECK(inside > 0);
}

TEST_CASE("a straight floor is worn most at the end of the range, and what is no stream wears none") {
  const CenterlinePtr straight = track(0.9, {{5.0, 0.0, 0.0}});
  const Friction low = Friction::from_coefficient(0.1);
  const Friction high = Friction::from_coefficient(0.6);
  CHECK_FALSE(friction_of_most_wear(straight, stream(0.0, 2.0), kDefaultGravity, low, high));
  CHECK_FALSE(friction_of_most_wear(straight, stream(0.0, 2.0), kDefaultGravity, low, low));
  CHECK_THROWS_WITH(friction_of_most_wear(straight, Body{}, kDefaultGravity, low, high),
                    Catch::Matchers::Contains("it is no stream of bulk solid"));
}

}  // namespace most_wear_test
