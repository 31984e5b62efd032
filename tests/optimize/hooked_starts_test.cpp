// A cap on the speed far below what the drop gives: falls, rides at the cap and hooks.

#include "optimize/search/hooked_starts.hpp"

#include "optimize/hooks_by_hand.hpp"
#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace hooked_starts_test {

using namespace glissade;
using namespace glissade::optimizer;

namespace {

Problem capped(double run, double drop, double mu, double cap) {
  Problem problem;
  problem.endpoints = {run, drop};
  problem.body.friction = Friction::from_coefficient(mu);
  problem.limits.speed.highest = cap;
  return problem;
}

struct Place {
  double x = 0.0;
  double y = 0.0;
};

/// Where a curve leads, by trapezoids between its entries: in chords.
Place end_of(const GuessCurve& curve) {
  Place end;
  for (std::size_t i = 1; i < curve.sigma.size(); ++i) {
    const double ds = (curve.sigma[i] - curve.sigma[i - 1]) * curve.length;
    end.x += 0.5 * ds * (std::cos(curve.zeta[i]) + std::cos(curve.zeta[i - 1]));
    end.y += 0.5 * ds * (std::sin(curve.zeta[i]) + std::sin(curve.zeta[i - 1]));
  }
  return end;
}

}  // namespace

TEST_CASE("hooks lead to the finish, and keep what limits there are on slope and curvature") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int found = 0;
  for (int i = 0; i < 12; ++i) {
    const double run = random.between(2.0, 30.0);
    const double mu = random.between(0.1, 0.5);
    const double drop = run * (mu + random.between(0.2, 0.8));
    const double fastest = std::sqrt(2.0 * 9.80665 * (drop - mu * run));
    Problem drawn = capped(run, drop, mu, random.between(0.5, 0.75) * fastest);
    const double chord = std::hypot(run, drop);
    drawn.limits.smallest_valley_radius = random.between(0.02, 0.05) * chord;
    drawn.limits.slope_angle.lowest = random.between(-1.2, -0.5);
    const ScaledProblem problem = scaled(drawn, {});
    CAPTURE(i, run, drop, mu, drawn.limits.speed.highest.value());
    for (const GuessCurve& curve : hooked_starts(problem)) {
      ++found;
      const Place end = end_of(curve);
      CHECK(end.x == Approx(problem.run).margin(5e-3));
      CHECK(end.y == Approx(problem.drop).margin(5e-3));
      for (std::size_t k = 1; k < curve.sigma.size(); ++k) {
        const double ds = (curve.sigma[k] - curve.sigma[k - 1]) * curve.length;
        const double bend = (curve.zeta[k - 1] - curve.zeta[k]) / ds;
        CHECK(bend <= 1.0001 * chord / *drawn.limits.smallest_valley_radius);
        CHECK(curve.zeta[k] >= *drawn.limits.slope_angle.lowest - 0.1);  // a step more
      }
    }
  }
  CHECK(found > 6);
}

TEST_CASE("where a fall and a ride at the cap lead down far enough there are no hooks") {
  CHECK(hooked_starts(scaled(capped(10.0, 5.0, 0.3, 5.6368), {})).empty());
  CHECK(hooked_starts(scaled(capped(10.0, 5.0, 0.2, 6.9036), {})).empty());
  CHECK_FALSE(hooked_starts(scaled(capped(10.0, 5.0, 0.3, 3.7579), {})).empty());
  Problem smooth = capped(10.0, 5.0, 0.3, 3.7579);
  smooth.limits.highest_curvature_rate = 1.0;
  CHECK(hooked_starts(scaled(smooth, {})).empty());
  CHECK(hooked_starts(scaled(capped(10.0, 5.0, 0.3, 3.7579), {})).size() <= 4);
}

TEST_CASE(
    "a cap far below what the drop gives: no slower than tracks of falls, rides at the cap and hooks by "
    "hand") {
  struct Known {
    double run, drop, mu, cap;
  };
  std::vector<Known> all{{10.0, 5.0, 0.3, 4.6973}};
  if (testing::thorough()) all.insert(all.end(), {{10.0, 5.0, 0.3, 3.7579}, {3.0, 4.0, 0.3, 4.6785}});
  for (const Known& known : all) {
    CAPTURE(known.run, known.drop, known.mu, known.cap);
    const std::optional<double> by_hand =
        testing_problems::least_time_with_hooks(known.run, known.drop, known.mu, known.cap);
    REQUIRE(by_hand);
    const Optimum optimum = testing_problems::solved(capped(known.run, known.drop, known.mu, known.cap));
    CHECK(optimum.report.travel_time <= *by_hand);
    // By hand hooks have a radius of a 300th of the chord, and all turn alike: that is no more than this behind.
    CHECK(optimum.report.travel_time > 0.97 * *by_hand);
  }
}

}  // namespace hooked_starts_test
