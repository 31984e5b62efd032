// Ways past obstacles: the best one is taken, and those plainly behind it are not searched to their ends.
#include "glissade/optimize/optimize.hpp"

#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>

namespace passages_test {

using namespace glissade;
using testing::Random;

namespace {

KeepOut box(Vec2 middle, double half_width, double half_height, double clearance) {
  return {{{middle.x - half_width, middle.y - half_height},
           {middle.x + half_width, middle.y - half_height},
           {middle.x + half_width, middle.y + half_height},
           {middle.x - half_width, middle.y + half_height}},
          clearance,
          Passage::either};
}

/// A track with a box somewhere along the straight line.
Problem past_box(Random& random, int index) {
  Problem problem;
  const double run = random.between(4.0, 30.0);
  const double drop = run * random.between(0.35, 1.1);
  problem.endpoints = {run, drop};
  problem.body.friction = Friction::from_coefficient(random.between(0.05, 0.25));
  Limits& limits = problem.limits;
  if (index % 3 == 0) limits.envelope.above = random.between(0.1, 0.5);
  if (index % 2 == 1) {
    limits.smallest_valley_radius = random.between(0.05, 0.3) * run;
    limits.smallest_crest_radius = random.between(0.05, 0.3) * run;
  }
  if (index % 5 == 0) problem.body.entry_speed = random.between(1.0, 5.0);
  const double x = random.between(0.2, 0.8) * run;
  const double y = x * drop / run + random.between(-0.2, 0.35) * drop;
  const double half_width = random.between(0.02, 0.15) * run;
  limits.keep_outs.push_back(
      box({x, y}, half_width, random.between(0.02, 0.1) * drop, random.between(0.0, 0.05) * drop));
  return problem;
}

double time_of(Problem problem, Passage passage) {
  problem.limits.keep_outs.front().passage = passage;
  const Optimum optimum = optimize(problem);
  return optimum.centerline ? optimum.report.travel_time : HUGE_VAL;
}

}  // namespace

TEST_CASE("past a box either way is as fast as the better one of both") {
  Random random = testing::seeded_random(20261126);
  INFO("GLISSADE_SEED=" << random.seed());
  const int count = testing::thorough() ? 60 : 8;
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const Problem problem = past_box(random, i);
    // The first one takes longer over its box than the next ten together, elsewhere than in CI left out.
    if (i == 0 && !testing::thorough()) continue;
    const double above = time_of(problem, Passage::above);
    const double below = time_of(problem, Passage::below);
    const double either = time_of(problem, Passage::either);
    INFO("problem " << i << ": above " << above << " s, below " << below << " s, either " << either << " s");
    const double best = std::min(above, below);
    if (!std::isfinite(best)) continue;
    ++found;
    CHECK(std::fabs(either - best) <= 1e-6 * best);
  }
  CHECK(found >= count / 2);
}

TEST_CASE("a way over a beam that is plainly behind costs next to nothing") {
  // Walls of 600 mm beneath a beam; over it tracks have to climb, and searches for them take long.
  for (const double level : {4.9, 5.0, 5.1}) {
    Problem problem;
    problem.endpoints = {5.4, 5.1};
    problem.body.friction = Friction::from_angle(Angle::from_degrees(17.0));
    problem.limits.envelope.below = 0.004;
    problem.limits.envelope.above = 0.6;
    problem.limits.keep_outs.push_back(box({1.4, 6.2 - (level + 0.25)}, 0.2, 0.25, 0.1));
    const Optimum optimum = testing_problems::solved(problem);
    INFO("beam " << level << " m up: " << optimum.report.evaluations << " evaluations");
    CHECK(optimum.report.evaluations < 1000);
  }
}

}  // namespace passages_test
