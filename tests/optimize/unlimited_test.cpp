// Without limits the search must find the exact optimum, which it is never told.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

namespace unlimited_test {

using namespace glissade;

namespace {

double excess(const Problem& problem, double exact) {
  const Optimum optimum = optimize(problem);
  CHECK(optimum.report.status == OptimizeStatus::optimal);
  REQUIRE(optimum.centerline);
  return optimum.report.travel_time / exact - 1.0;
}

}  // namespace

TEST_CASE("published times are met without a guess") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.gravity = 9.80665;
  // Frictionless, (10, 5): the cycloid's own time.
  CHECK(std::fabs(excess(problem, 1.801603122453)) < kOptimizeAccuracy);

  problem.endpoints = {1.0, 0.0};
  problem.finish.kind = FinishKind::vertical_line;
  problem.gravity = 32.174;
  // Frictionless to a wall at 1 (ft) with the drop free: sqrt(pi/g).
  CHECK(std::fabs(excess(problem, 0.312480130708665)) < kOptimizeAccuracy);
}

TEST_CASE("a track of any size is the same track") {
  Problem small;
  small.endpoints = {0.012, 0.006};
  small.body.friction = Friction::from_coefficient(0.25);
  small.limits.slope_angle.highest = 0.8;
  Problem large = small;
  const double scale = 65536.0;
  large.endpoints = {scale * small.endpoints.run, scale * small.endpoints.drop};
  const Optimum little = optimize(small);
  const Optimum big = optimize(large);
  REQUIRE(little.report.status == OptimizeStatus::optimal);
  CHECK(big.report.evaluations == little.report.evaluations);
  CHECK(big.report.travel_time == Approx(256.0 * little.report.travel_time).epsilon(1e-12));
}

TEST_CASE("two runs of the same problem end in the same bits") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.highest_normal_load = 14.0;
  CHECK(optimize(problem).report.travel_time == optimize(problem).report.travel_time);
}

TEST_CASE("random reachable problems end within the stated accuracy of the exact optimum, never below it") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < (testing::thorough() ? 200 : 100); ++i) {
    Problem problem;
    const double mu = random.between(0.0, 1.0);
    const double ratio = std::exp(random.between(std::log(std::max(1.02 * mu, 0.02)), std::log(5.0)));
    problem.endpoints.run = std::pow(10.0, random.between(-2.0, 3.0));
    problem.endpoints.drop = ratio * problem.endpoints.run;
    problem.body.friction = Friction::from_coefficient(mu);
    const double exact = solve_coulomb_brachistochrone(problem.endpoints, problem.body.friction).travel_time;
    CAPTURE(i, mu, ratio);
    const double found = excess(problem, exact);
    CHECK(found <= kOptimizeAccuracy);
    CHECK(found >= -kOptimizeUndershoot);
  }
}

}  // namespace unlimited_test
