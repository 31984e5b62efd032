// What is told as kept is kept at every friction of a range, whichever way a track was found: rides of the test's own say so.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/ore.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace friction_range_test {

using namespace glissade;

namespace {

constexpr double kGravity = 9.81;
// Of a speed or a load; what is told as kept may miss its bound by as much.
constexpr double kKept = 1e-6;

std::vector<Friction> frictions_of(const Problem& problem) {
  std::vector<Friction> frictions{problem.body.friction};
  if (problem.low_friction) frictions.push_back(*problem.low_friction);
  if (problem.high_friction) frictions.push_back(*problem.high_friction);
  return frictions;
}

/// Rides a track at each friction of the range, and holds limits on speeds and loads against it.
void check_rides(const Problem& problem, const CenterlinePtr& track) {
  const Limits& limits = problem.limits;
  const double speed_scale = std::sqrt(kGravity * std::max(1.0, track->length()));
  for (const Friction& friction : frictions_of(problem)) {
    Body body = problem.body;
    body.friction = friction;
    const Motion ride(track, body, problem.gravity);
    CAPTURE(friction.coefficient());
    REQUIRE(ride.arrived());
    const double exit = ride.exit_speed();
    const double load = ride.highest_load().normal_load;
    CAPTURE(exit, load, ride.highest_speed().speed);
    if (limits.exit_speed.lowest) CHECK(exit >= *limits.exit_speed.lowest - kKept * speed_scale);
    if (limits.exit_speed.highest) CHECK(exit <= *limits.exit_speed.highest + kKept * speed_scale);
    if (limits.speed.highest)
      CHECK(ride.highest_speed().speed <= *limits.speed.highest + kKept * speed_scale);
    if (limits.highest_normal_load) CHECK(load <= *limits.highest_normal_load + kKept * kGravity);
    if (limits.lowest_normal_load)
      CHECK(ride.lowest_load().normal_load >= *limits.lowest_normal_load - kKept * kGravity);
  }
}

/// Between two points, or from a start that is free where a length is made least, or on sites where the end is.
Problem with_range(testing::Random& random, ObjectiveKind objective) {
  const auto chance = [&](double share) { return random.between(0.0, 1.0) < share; };
  Problem problem;
  problem.gravity = kGravity;
  problem.objective.kind = objective;
  const double mu = random.between(0.02, 0.3);
  problem.body.friction = Friction::from_coefficient(mu);
  const bool rough_only = chance(0.3);
  if (!rough_only) problem.low_friction = Friction::from_coefficient(random.between(0.5, 1.0) * mu);
  problem.high_friction = Friction::from_coefficient(random.between(1.0, 1.6) * mu);
  const double run = random.between(4.0, 30.0);
  const double drop = run * (1.6 * mu + random.between(0.1, 0.6));
  problem.endpoints = {run, drop};
  if (chance(0.3)) problem.body.entry_speed = random.between(0.5, 3.0);
  if (chance(0.3)) problem.body.drag_per_metre = random.between(0.001, 0.01);
  if (chance(0.2)) problem.objective.worst_case = !is_least_bound(objective);
  Limits& limits = problem.limits;
  if (chance(0.3)) limits.smallest_valley_radius = random.between(1.0, 6.0);
  if (chance(0.3)) limits.smallest_crest_radius = random.between(1.0, 6.0);
  if (chance(0.3)) limits.lead_out = random.between(0.1, 1.0);
  // What the straight line gives at the highest friction: bounds are drawn about that.
  const double fall = 2.0 * kGravity * (drop - run * problem.high_friction->coefficient());
  const double reached = std::sqrt(fall + std::pow(problem.body.entry_speed, 2));
  const bool free_start = objective == ObjectiveKind::least_drop || objective == ObjectiveKind::least_length;
  if (free_start) {
    problem.finish.kind = FinishKind::anywhere;
    limits.slope_angle.highest = random.between(0.6, 1.2);
  }
  const bool asks = free_start || is_least_bound(objective) || chance(0.3);
  if (asks) limits.exit_speed.lowest = random.between(0.8, 1.0) * reached;
  if (chance(0.25) && !free_start) limits.speed.highest = random.between(1.05, 1.4) * reached;
  if (chance(0.25)) limits.highest_normal_load = kGravity * random.between(1.1, 2.0);
  return problem;
}

}  // namespace

TEST_CASE("what is told as kept is kept at every friction of the range, whatever is made least") {
  testing::Random random = testing::seeded_random(20250401);
  INFO("GLISSADE_SEED=" << random.seed());
  const int problems = testing::thorough() ? 14 : 1;
  int told = 0;
  for (int i = 0; i < problems; ++i) {
    for (const ObjectiveKind kind :
         {ObjectiveKind::travel_time, ObjectiveKind::exit_speed, ObjectiveKind::least_wear,
          ObjectiveKind::least_drop, ObjectiveKind::least_length, ObjectiveKind::least_load,
          ObjectiveKind::least_curvature_rate, ObjectiveKind::blend}) {
      Problem problem = with_range(random, kind);
      if (kind == ObjectiveKind::blend) problem.objective.exit_speed_weight = 0.05;
      OptimizeOptions options;
      options.time_budget = testing::thorough() ? 4.0 : 0.5;
      const Optimum optimum = optimize(problem, options);
      CAPTURE(i, static_cast<int>(kind), optimum.report.brief());
      if (!optimum.centerline) continue;
      ++told;
      for (const LimitCheck& check : optimum.report.checks) {
        CAPTURE(check.limit.key(), check.value, check.reached);
        CHECK(check.kept());
      }
      check_rides(problem, optimum.centerline);
    }
  }
  CHECK(told > 3 * problems);
}

TEST_CASE("of streams, too, what is told as kept is kept at every friction of the range") {
  testing::Random random = testing::seeded_random(20250403);
  INFO("GLISSADE_SEED=" << random.seed());
  int told = 0;
  for (int i = testing::thorough() ? 6 : 1; i > 0; --i) {
    for (const ObjectiveKind kind :
         {ObjectiveKind::travel_time, ObjectiveKind::even_speed, ObjectiveKind::least_peak_wear}) {
      const double run = random.between(2.0, 5.0);
      Problem problem = testing_problems::ore(run, run * random.between(0.9, 1.3), random.between(1.5, 4.0));
      problem.gravity = kGravity;
      problem.low_friction = Friction::from_coefficient(0.44);
      problem.high_friction = Friction::from_coefficient(random.between(0.52, 0.6));
      problem.objective.kind = kind;
      problem.limits.smallest_valley_radius = random.between(1.0, 3.0);
      problem.limits.highest_normal_load = kGravity * random.between(1.5, 3.0);
      problem.limits.speed.highest =
          std::sqrt(2.0 * kGravity * problem.endpoints.drop) * random.between(0.7, 1.0);
      OptimizeOptions options;
      options.time_budget = testing::thorough() ? 6.0 : 0.7;
      const Optimum optimum = optimize(problem, options);
      CAPTURE(i, static_cast<int>(kind), optimum.report.brief());
      if (!optimum.centerline) continue;
      ++told;
      for (const LimitCheck& check : optimum.report.checks) CHECK(check.kept());
      check_rides(problem, optimum.centerline);
    }
  }
  CHECK(told > 0);
}

TEST_CASE("a least bound is found for the friction at which the body arrives slowest") {
  // The straight line arrives with 8.2 m/s at the body's own friction, with 7.98 m/s at the highest one.
  std::vector<ObjectiveKind> kinds{ObjectiveKind::least_load};
  if (testing::thorough()) kinds.push_back(ObjectiveKind::least_curvature_rate);
  for (const ObjectiveKind kind : kinds) {
    Problem problem;
    problem.gravity = kGravity;
    problem.endpoints = {10.0, 4.4};
    problem.body.friction = Friction::from_coefficient(0.1);
    problem.low_friction = Friction::from_coefficient(0.08);
    problem.high_friction = Friction::from_coefficient(0.1155);
    problem.objective.kind = kind;
    problem.limits.exit_speed.lowest = 8.0;
    problem.limits.smallest_crest_radius = 2.0;
    problem.limits.smallest_valley_radius = 2.0;
    const Optimum optimum = optimize(problem);
    CAPTURE(static_cast<int>(kind), optimum.report.brief());
    REQUIRE(optimum.centerline);
    check_rides(problem, optimum.centerline);
    for (const LimitCheck& check : optimum.report.checks) CHECK(check.kept());
  }
}

namespace {

/// An arc that bends down all along: a body carries less than its weight on it, and the slowest one of a range the most.
CenterlinePtr crest(testing::Random& random) {
  const double entry = random.between(-0.1, 0.1);
  const double exit = entry + random.between(0.3, 0.5);
  const double radius = random.between(8.0, 20.0);
  const double length = radius * (exit - entry);
  return std::make_shared<const ClothoidSpline>(
      Angle::from_radians(entry), std::vector<ClothoidSegment>{{length, -1.0 / radius, -1.0 / radius}});
}

}  // namespace

TEST_CASE("a highest load below the weight is held on the slowest body: over a crest that carries the most") {
  testing::Random random = testing::seeded_random(20250408);
  INFO("GLISSADE_SEED=" << random.seed());
  int drawn = 0;
  for (int tries = 0; drawn < (testing::thorough() ? 20 : 4) && tries < 400; ++tries) {
    const CenterlinePtr arc = crest(random);
    Problem problem;
    problem.gravity = kGravity;
    problem.endpoints = arc->endpoints();
    const double mu = random.between(0.05, 0.1);
    problem.body.friction = Friction::from_coefficient(mu);
    problem.low_friction = Friction::from_coefficient(0.5 * mu);
    problem.high_friction = Friction::from_coefficient(1.5 * mu);
    problem.body.entry_speed = random.between(3.0, 7.0);
    double fastest = 0.0;
    double slowest = 0.0;
    double nominal = 0.0;
    for (const Friction& friction : frictions_of(problem)) {
      Body body = problem.body;
      body.friction = friction;
      const Motion ride(arc, body, problem.gravity);
      if (!ride.arrived()) break;
      const double load = ride.highest_load().normal_load;
      if (friction == problem.body.friction) nominal = ride.travel_time();
      if (friction == *problem.low_friction) fastest = load;
      if (friction == *problem.high_friction) slowest = load;
    }
    if (!(fastest > 0.0 && slowest > fastest + 0.02 && slowest < 0.9 * kGravity)) continue;
    ++drawn;
    // The arc keeps it, and leaves room for others.
    problem.limits.highest_normal_load = slowest + 0.05;
    problem.limits.smallest_crest_radius = 5.0;
    problem.limits.smallest_valley_radius = 5.0;
    const Optimum optimum = optimize(problem);
    CAPTURE(tries, fastest, slowest, problem.body.entry_speed, optimum.report.brief());
    REQUIRE(optimum.centerline);
    CHECK(optimum.report.status == OptimizeStatus::optimal);
    CHECK(optimum.report.travel_time <= nominal * (1.0 + 1e-6));
    check_rides(problem, optimum.centerline);
  }
  CHECK(drawn >= 4);
}

TEST_CASE("a least load below the weight is found for the slowest body of a range") {
  Problem problem;
  problem.gravity = kGravity;
  problem.endpoints = {4.66, 1.681};
  problem.body.friction = Friction::from_coefficient(0.052);
  problem.low_friction = Friction::from_coefficient(0.03505);
  problem.high_friction = Friction::from_coefficient(0.05933);
  problem.body.entry_speed = 2.384;
  problem.body.drag_per_metre = 0.006723;
  problem.limits.smallest_valley_radius = 1.741;
  problem.limits.smallest_crest_radius = 1.741;
  problem.limits.slope_angle = {Angle::from_degrees(-4.653).radians(), Angle::from_degrees(28.73).radians()};
  problem.limits.lowest_normal_load = 0.2771 * kGravity;
  // A track of piecewise constant curvature that an independent search found carries 8.130 m/s^2.
  problem.limits.highest_normal_load = 8.131;
  const Optimum within = optimize(problem);
  INFO(within.report.brief());
  REQUIRE(within.centerline);
  check_rides(problem, within.centerline);
  if (!testing::thorough()) return;
  problem.limits.highest_normal_load = 1.591 * kGravity;
  problem.limits.exit_speed.lowest = 2.877;
  problem.objective.kind = ObjectiveKind::least_load;
  const Optimum least = optimize(problem);
  INFO(least.report.brief());
  REQUIRE(least.report.status == OptimizeStatus::optimal);
  problem.limits.highest_normal_load = 8.1272;
  check_rides(problem, least.centerline);
}

}  // namespace friction_range_test
