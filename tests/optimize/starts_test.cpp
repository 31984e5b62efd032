// What searches begin with.

#include "optimize/search/starts.hpp"

#include "glissade/centerline/straight_line.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/problem/scaled_problem.hpp"
#include "optimize/random_limits.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

using namespace glissade;
using namespace glissade::optimizer;

namespace {

bool is_finite(const GuessCurve& curve) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::isfinite(curve.length) && curve.length > 0.0 &&
         std::all_of(curve.sigma.begin(), curve.sigma.end(), finite) &&
         std::all_of(curve.zeta.begin(), curve.zeta.end(), finite);
}

}  // namespace

TEST_CASE("starts are tracks of finite length, up to the reach limit") {
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 300; ++i) {
    Problem drawn = testing_problems::random_limited(random);
    // From far above the reach limit to a billionth beside it.
    const double mu = drawn.body.friction.coefficient();
    drawn.endpoints.drop = drawn.endpoints.run * mu * (1.0 + std::pow(10.0, random.between(-9.0, 0.5)));
    if (!(mu > 1e-3)) continue;
    drawn.limits.keep_outs.clear();
    const ScaledProblem problem = scaled(drawn, {});
    CAPTURE(i, mu, drawn.endpoints.run, drawn.endpoints.drop);
    for (const auto curves_of : {&starts, &constant_speed_starts, &winding_starts, &stepped_starts}) {
      for (const GuessCurve& curve : curves_of(problem)) CHECK(is_finite(curve));
    }
  }
}

TEST_CASE("a straight line takes as long as a body that is ridden along it") {
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 20; ++i) {
    Problem drawn;
    drawn.endpoints = {random.between(1.0, 50.0), random.between(-3.0, 30.0)};
    drawn.body.friction = Friction::from_coefficient(random.between(0.0, 0.5));
    drawn.body.entry_speed = random.between(0.0, 10.0);
    const ScaledProblem problem = scaled(drawn, {});
    const Motion ride(std::make_shared<StraightLine>(drawn.endpoints), drawn.body);
    CAPTURE(i, drawn.endpoints.run, drawn.endpoints.drop, drawn.body.entry_speed);
    const double time = straight_time(problem) * problem.time;
    CHECK(std::isfinite(time) == ride.arrived());
    if (ride.arrived()) CHECK(std::fabs(time / ride.travel_time() - 1.0) <= 1e-9);
  }
}

TEST_CASE("a longer straight at the start never makes the finish faster by another track") {
  // With one of these lengths the search ended in a track that begins uphill and all but stops: 14.135 m/s in 8 s.
  double before = HUGE_VAL;
  for (const double lead : {5.0627, 5.0639136, 5.0649}) {
    Problem problem;
    problem.endpoints = {50.0, 18.4732106712};
    problem.body.friction = Friction::from_coefficient(0.18117);
    problem.body.drag_per_metre = 0.0013571;
    problem.body.entry_speed = 5.3713;
    problem.objective.kind = ObjectiveKind::exit_speed;
    problem.limits.waypoints = {{25.8759677312, 12.41052238704}};
    problem.limits.lead_in = lead;
    problem.limits.lead_out = 2.14600696834;
    problem.limits.entry_slope_angle.highest = Angle::from_degrees(32.3385).radians();
    problem.limits.exit_slope_angle.lowest = Angle::from_degrees(11.8847).radians();
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(lead, report.brief());
    CHECK(report.exit_speed > 14.335);
    CHECK(report.exit_speed < before * (1.0 + 1e-4));
    before = report.exit_speed;
  }
}
