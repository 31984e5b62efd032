// One thing of a problem is changed, and the order of the answers is held: a limit that gives way, a narrower range of
// friction, a mirror, another size, another height.

#include "optimize/drawn_problems.hpp"
#include "optimize/random_limits.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace glissade;

namespace {

// Relative, of the objective.
constexpr double kSame = 1e-5;
constexpr double kDegree = std::numbers::pi / 180.0;

double objective_of(const Problem& problem, const OptimizeReport& report) {
  return problem.objective.kind == ObjectiveKind::exit_speed ? -report.exit_speed : report.travel_time;
}

/// Holds the answer to a changed problem against that to the problem it came from.
/// @param unit  of the objective in the changed problem, over that of the other
void compare(const std::string& change, const Problem& changed, double objective, double unit, bool same) {
  const Optimum optimum = optimize(changed);
  CAPTURE(change, optimum.report.brief());
  REQUIRE(optimum.centerline);
  const double excess = objective_of(changed, optimum.report) / unit - objective;
  CAPTURE(excess / std::fabs(objective));
  CHECK(excess <= kSame * std::fabs(objective));
  if (same) CHECK(excess >= -kSame * std::fabs(objective));
}

/// A tenth of the problems of other tests: each of these is solved some ten times.
int problem_count() {
  return std::max(4, testing_problems::problem_count() / 20);
}

}  // namespace

TEST_CASE("a limit that gives way never makes a problem infeasible, nor its track slower") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int problems = problem_count();
  int solved = 0;
  for (int i = 0; i < problems; ++i) {
    const Problem problem = testing_problems::drawn(random);
    const Optimum optimum = optimize(problem);
    if (!optimum.centerline) continue;
    ++solved;
    CAPTURE(i, optimum.report.brief());
    const double objective = objective_of(problem, optimum.report);
    for (const testing_problems::Variant& variant : testing_problems::relaxed(problem)) {
      compare(variant.name, variant.problem, objective, 1.0, false);
    }
    if (problem.low_friction) {
      Problem narrow = problem;
      narrow.low_friction.reset();
      narrow.high_friction.reset();
      compare("without a friction range", narrow, objective, 1.0, false);
    }
  }
  CHECK(solved > problems / 2);
}

TEST_CASE("mirrored, of another size and at another height a problem has the same answer") {
  testing::Random random = testing::seeded_random(20250218);
  INFO("GLISSADE_SEED=" << random.seed());
  const int problems = problem_count();
  for (int i = 0; i < problems; ++i) {
    const Problem problem = testing_problems::drawn(random);
    const Optimum optimum = optimize(problem);
    if (!optimum.centerline) continue;
    CAPTURE(i, optimum.report.brief());
    const double objective = objective_of(problem, optimum.report);
    Problem mirrored = problem;
    mirrored.endpoints.run = -mirrored.endpoints.run;
    compare("mirrored", mirrored, objective, 1.0, true);
    compare("lifted", testing_problems::lifted(problem, 4000.0), objective, 1.0, true);
    for (const double size : {1e-2, 1e3}) {
      compare("resized", testing_problems::resized(problem, size), objective, std::sqrt(size), true);
    }
  }
}

TEST_CASE("a cap on the speed that takes bends to keep is kept, down to where it winds") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.slope_angle = {0.0, 60.0 * kDegree};
  problem.limits.smallest_valley_radius = 1.0;
  problem.limits.smallest_crest_radius = 1.0;
  double before = 0.0;
  for (const double cap : {6.8, 6.6, 6.4}) {
    problem.limits.speed.highest = cap;
    const Optimum optimum = optimize(problem);
    CAPTURE(cap, optimum.report.brief());
    REQUIRE(optimum.centerline);
    CHECK(optimum.report.travel_time >= before * (1.0 - kSame));
    before = optimum.report.travel_time;
  }
  problem.endpoints = {10.0, 6.0};
  problem.body.friction = Friction::from_coefficient(0.3);
  problem.limits.slope_angle.highest = 70.0 * kDegree;
  problem.limits.smallest_valley_radius = 0.8;
  problem.limits.smallest_crest_radius = 0.8;
  problem.limits.speed.highest = 5.87;
  CHECK(optimize(problem).centerline);
}

TEST_CASE("ground with a cliff or a gully is no wall") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.limits.stay_above = {{{{0.0, 3.0}, {4.0, 4.0}, {4.5, 30.0}, {5.0, 4.0}, {10.0, 5.2}}, 0.0}};
  const Optimum gully = optimize(problem);
  INFO(gully.report.brief());
  REQUIRE(gully.report.status == OptimizeStatus::optimal);
  problem.limits.stay_above = {{{{0.0, 3.0}, {4.0, 4.0}, {5.0, 4.0}, {10.0, 5.2}}, 0.0}};
  CHECK(gully.report.travel_time <= optimize(problem).report.travel_time * (1.0 + kSame));
  problem.limits.stay_above = {{{{0.0, 0.5}, {4.0, 1.9}, {4.1, 8.0}, {10.0, 9.0}}, 0.0}};
  CHECK(optimize(problem).report.status == OptimizeStatus::optimal);
}

TEST_CASE("a rate of curvature that leaves little more than arcs is no contradiction") {
  for (const double mu : {0.0, 0.2, 0.4}) {
    Problem problem;
    problem.endpoints = {3.0, 2.0};
    problem.body.friction = Friction::from_coefficient(mu);
    problem.limits.highest_curvature_rate = 1e-7;
    const Optimum optimum = optimize(problem);
    CAPTURE(mu, optimum.report.brief());
    REQUIRE(optimum.centerline);
    const double length = std::hypot(3.0, 2.0);
    const double straight = std::sqrt(2.0 * length * length / (problem.gravity * (2.0 - 3.0 * mu)));
    CHECK(optimum.report.travel_time < straight);
  }
}
