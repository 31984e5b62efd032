// The search for bodies that are not the sliding point: against optima that are known, and against neighbours.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/motion/laws/rider.hpp"
#include "glissade/motion/laws/rolling_ball.hpp"
#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"
#include "support/neighbours.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace laws_test {

using namespace glissade;

namespace {

constexpr double kGravity = kDefaultGravity;

LawPtr ball(double radius, std::optional<double> centre_height = {}) {
  BallShape shape;
  shape.radius = radius;
  shape.centre_height = centre_height;
  return std::make_shared<const RollingBall>(shape);
}

LawPtr stream(double mass_flow) {
  return std::make_shared<const BulkStream>(StreamShape{mass_flow, 1000.0, 0.5, 0.5, {}});
}

Problem problem(double run, double drop, double mu, double entry_speed, LawPtr law) {
  Problem problem;
  problem.endpoints = {run, drop};
  problem.body.friction = Friction::from_coefficient(mu);
  problem.body.entry_speed = entry_speed;
  problem.body.law = std::move(law);
  return problem;
}

}  // namespace

TEST_CASE("laws: the fastest track of a frictionless ball is the cycloid, sqrt(7/5) times as slow") {
  // So small a height of the centre that its path is the track.
  const Optimum optimum = optimize(problem(10.0, 5.0, 0.0, 0.0, ball(0.1, 1e-7)));
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  const double cycloid = solve_coulomb_brachistochrone({10.0, 5.0}, Friction{}).travel_time;
  CHECK(optimum.report.travel_time == Approx(std::sqrt(1.4) * cycloid).epsilon(1e-6));
  CHECK(optimum.report.travel_time > std::sqrt(1.4) * cycloid * (1.0 - 1e-9));
  CHECK_FALSE(optimum.report.unlimited_travel_time);
}

TEST_CASE("laws: with its exit given, the centre of a frictionless ball takes the cycloid beside the track") {
  // It starts vertical, which is as steep as a track may be. The centre's cycloid, x = a (t - sin t),
  // y = a (1 - cos t), slope 90 deg - t/2, to t = 2.4; the track lies h below it, square to it.
  constexpr double kA = 1.0;
  constexpr double kEnd = 2.4;
  constexpr double kHeight = 0.15;
  const double exit = 0.5 * (std::numbers::pi - kEnd);
  const double x = kA * (kEnd - std::sin(kEnd)) - kHeight * (std::sin(exit) - 1.0);
  const double y = kA * (1.0 - std::cos(kEnd)) + kHeight * std::cos(exit);
  Problem given = problem(x, y, 0.0, 0.0, ball(kHeight));
  given.limits.exit_slope_angle = Range::fixed(exit);
  given.limits.smallest_valley_radius = kHeight / 0.98;
  const Optimum optimum = optimize(given);
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  const double exact = std::sqrt(1.4) * kEnd * std::sqrt(kA / kGravity);
  CHECK(optimum.report.travel_time == Approx(exact).epsilon(1e-6));
  CHECK(optimum.report.travel_time > exact * (1.0 - 1e-9));
}

TEST_CASE("laws: no neighbour of the fastest track is faster, whatever moves") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  struct Case {
    std::string name;
    Problem problem;
  };
  std::vector<Case> cases = {
      {"ball", problem(2.0, 1.0, 0.05, 0.0, ball(0.02))},
      {"ball with speed", problem(2.0, 0.3, 0.05, 2.0, ball(0.02))},
      {"rider", problem(60.0, 30.0, 0.03, 3.0, std::make_shared<const Rider>(0.6))},
      {"stream", problem(4.0, 5.0, 0.4, 2.0, stream(150.0))},
      {"wind", problem(60.0, 30.0, 0.03, 3.0, nullptr)},
  };
  cases.back().problem.body.drag_per_metre = 0.01;
  cases.back().problem.body.head_wind = 8.0;
  for (Case& one : cases) {
    // Away from the vertical and from bends that the neighbours would break.
    one.problem.limits.slope_angle.highest = 1.3;
    one.problem.limits.entry_slope_angle = Range::fixed(1.1);
    one.problem.limits.exit_slope_angle = Range::fixed(0.2);
    const Optimum optimum = optimize(one.problem);
    CAPTURE(one.name, optimum.report.message);
    REQUIRE(optimum.report.status == OptimizeStatus::optimal);
    const auto* spline = dynamic_cast<const ClothoidSpline*>(optimum.centerline.get());
    REQUIRE(spline != nullptr);
    const double best = Motion(optimum.centerline, one.problem.body).travel_time();
    CHECK(best == optimum.report.travel_time);
    int faster = 0;
    int rides = 0;
    // Neighbours differ in their end slopes too: what those are worth is known from the multipliers.
    double price = 0.0;
    for (const ActiveLimit& active : optimum.report.active) {
      if (active.limit.id == LimitId::entry_slope_angle || active.limit.id == LimitId::exit_slope_angle)
        price += active.price;
    }
    const int neighbours = testing::thorough() ? 400 : 80;
    for (int i = 0; i < neighbours; ++i) {
      const CenterlinePtr other = testing::neighbour(*spline, random, random.between(-0.05, 0.05));
      const Motion ride(other, one.problem.body);
      const double end = other->length();
      const double turned =
          std::fabs(other->slope_angle(0.0) - 1.1) + std::fabs(other->slope_angle(end) - 0.2);
      if (!ride.arrived()) continue;
      ++rides;
      if (ride.travel_time() < best - 1.05 * price * turned - 1e-7 * best) ++faster;
    }
    CHECK(rides > neighbours / 20);
    CHECK(faster == 0);
  }
}

namespace {

/// Holds a track against those of one limit more, end slopes by 1.5 deg steeper or flatter than its own.
/// @return how many of these there are
int hold_against_other_ends(const Problem& given) {
  constexpr double kTurn = 1.5 * std::numbers::pi / 180.0;
  constexpr double kSame = 1e-5;  // what is told as optimal is good to
  const Optimum optimum = optimize(given);
  if (optimum.report.status != OptimizeStatus::optimal) return 0;
  const double entry = optimum.centerline->slope_angle(0.0);
  const double exit = optimum.centerline->slope_angle(optimum.centerline->length());
  int held = 0;
  for (const double turn : {-kTurn, kTurn}) {
    for (const bool at_exit : {false, true}) {
      Problem tighter = given;
      const double bound = (at_exit ? exit : entry) + turn;
      if (std::fabs(bound) > 0.5 * std::numbers::pi) continue;
      Range& range = at_exit ? tighter.limits.exit_slope_angle : tighter.limits.entry_slope_angle;
      (turn < 0.0 ? range.highest : range.lowest) = bound;
      const Optimum other = optimize(tighter);
      if (!other.centerline) continue;
      CAPTURE(at_exit, turn, other.report.brief());
      CHECK(other.report.travel_time >= optimum.report.travel_time * (1.0 - kSame));
      ++held;
    }
  }
  return held;
}

}  // namespace

TEST_CASE("laws: with one limit more on its end slopes no track of a high body is faster") {
  // A bend at an end, too short for the pieces there, was missed: these were told 3e-3, 5e-4, 3e-4 and 5e-5 too slow, as optimal.
  Problem tall = problem(7.1, 6.46, 0.18, 0.0, std::make_shared<const Rider>(0.7));
  tall.limits.concave = true;
  tall.limits.smallest_valley_radius = 1.9;
  tall.limits.lead_in = 1.28;
  tall.limits.entry_slope_angle.highest = 58.0 * std::numbers::pi / 180.0;
  tall.limits.waypoints = {{3.88, 6.46 - 2.77}};
  CHECK(hold_against_other_ends(tall) >= 3);
  if (!testing::thorough()) return;
  Problem marble = problem(0.2, 0.12, 0.01, 0.2, ball(8e-3));
  marble.limits.concave = true;
  marble.limits.smallest_valley_radius = 0.1;
  marble.limits.waypoints = {{0.12, 0.12 - 0.044}};
  CHECK(hold_against_other_ends(marble) >= 3);
  Problem bent_twice = problem(3.359, 3.462, 0.233, 1.29, std::make_shared<const Rider>(0.393));
  bent_twice.limits.concave = true;
  bent_twice.limits.smallest_valley_radius = 1.345;
  bent_twice.limits.lead_in = 0.454;
  bent_twice.limits.waypoints = {{1.012, 3.462 - 2.328}};
  CHECK(hold_against_other_ends(bent_twice) >= 3);
  Problem to_straight = problem(11.379, 11.161, 0.045, 0.0, ball(0.2997));
  to_straight.limits.concave = true;
  to_straight.limits.smallest_valley_radius = 2.484;
  to_straight.limits.lead_in = 1.802;
  to_straight.limits.lead_out = 0.879;
  to_straight.limits.waypoints = {{3.786, 11.161 - 6.94}};
  CHECK(hold_against_other_ends(to_straight) >= 3);
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int held = 0;
  for (int i = 0; i < 60; ++i) {
    const double run = random.between(3.0, 12.0);
    const double drop = run * random.between(0.5, 1.1);
    const bool rolls = random.integer(0, 1) == 0;
    const double mu = random.between(0.03, 0.3);
    const LawPtr law = rolls ? ball(run * random.between(0.005, 0.06))
                             : std::make_shared<const Rider>(run * random.between(0.02, 0.12));
    Problem given = problem(run, drop, rolls ? 0.2 * mu : mu, random.between(0.2, 4.0), law);
    given.limits.smallest_valley_radius = run * random.between(0.2, 0.6);
    given.limits.concave = random.integer(0, 2) > 0;
    if (!given.limits.concave) given.limits.smallest_crest_radius = run * random.between(0.2, 0.6);
    if (random.integer(0, 1) == 0) given.limits.lead_in = run * random.between(0.02, 0.2);
    if (random.integer(0, 2) == 0) given.limits.lead_out = run * random.between(0.02, 0.2);
    const double share = random.between(0.3, 0.7);
    const double below = drop * random.between(0.02, 0.12);
    if (random.integer(0, 3) > 0) given.limits.waypoints = {{run * share, drop * share + below}};
    CAPTURE(i);
    held += hold_against_other_ends(given);
  }
  CHECK(held > 120);
}

TEST_CASE("laws: where a high body turns down at once a tighter radius is not faster") {
  if (!testing::thorough()) return;  // some seconds
  // A corner at the start promises much from mesh to mesh: 1.3567 s was told as optimal for 2.779 m, where 1.2857 s do.
  Problem tall =
      problem(6.49510758714099, 3.55957443870462, std::tan(2.88113569366 * std::numbers::pi / 180.0), 1.54838,
              std::make_shared<const Rider>(0.707467086136115));
  tall.body.drag_per_metre = 0.0132717;
  tall.limits.entry_slope_angle.highest = 43.5468 * std::numbers::pi / 180.0;
  tall.limits.lead_out = 0.182896689017832;
  constexpr double kSame = 1e-5;
  double before = 0.0;
  for (const double radius : {2.764, 2.779, 2.784}) {
    tall.limits.smallest_valley_radius = radius;
    const OptimizeReport report = optimize(tall).report;
    CAPTURE(radius, report.brief());
    CHECK(report.status == OptimizeStatus::optimal);
    CHECK(report.finer_mesh_wins.value_or(1.0) < 2e-3);
    CHECK(report.travel_time >= before * (1.0 - kSame));
    before = report.travel_time;
  }
}

TEST_CASE("laws: limits hold for what rolls and flows, by the referee") {
  Problem given = problem(2.0, 1.2, 0.03, 0.0, ball(0.03));
  given.limits.slope_angle.highest = 0.8;
  given.limits.exit_slope_angle = Range::fixed(0.0);
  given.limits.smallest_valley_radius = 0.4;
  given.limits.highest_normal_load = 2.5 * kGravity;
  given.limits.speed.highest = 4.2;
  given.low_friction = Friction::from_coefficient(0.01);
  given.high_friction = Friction::from_coefficient(0.06);
  const Optimum optimum = optimize(given);
  CAPTURE(optimum.report.message);
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  for (const LimitCheck& check : optimum.report.checks) {
    CAPTURE(check.limit.key(), check.reached, check.value);
    CHECK(check.kept());
  }
  // The load is that of the centre's own path.
  const Motion motion(optimum.centerline, given.body);
  CHECK(motion.highest_load().normal_load <= 2.5 * kGravity * (1.0 + 1e-6));
}

TEST_CASE(
    "laws: the least wear of a body whose centre is high counts what its slopes at the ends lower it by") {
  Problem tall = problem(5.12, 1.85, 0.105, 2.78, std::make_shared<const Rider>(0.67));
  tall.objective.kind = ObjectiveKind::least_wear;
  tall.limits.slope_angle = {-0.166, 0.963};
  tall.limits.exit_slope_angle = {-0.046, 0.025};
  tall.limits.smallest_crest_radius = 4.16;
  const auto rubbed = [](const Problem& of, const Optimum& optimum) {
    const Motion motion(optimum.centerline, of.body, of.gravity);
    REQUIRE(motion.arrived());
    return motion.at(motion.distance()).friction_loss;
  };
  const Optimum least = optimize(tall);
  REQUIRE(least.report.status == OptimizeStatus::optimal);
  const double loss = rubbed(tall, least);
  // The greatest exit speed rubs 1 % more.
  Problem fast = tall;
  fast.objective.kind = ObjectiveKind::exit_speed;
  const Optimum fastest = optimize(fast);
  REQUIRE(fastest.centerline);
  CHECK(rubbed(tall, fastest) > 1.005 * loss);
  CHECK(fastest.report.exit_speed > least.report.exit_speed);
  // With the slopes at both ends given both ask for the same.
  const double entry = least.centerline->slope_angle(0.0);
  const double exit = least.centerline->slope_angle(least.centerline->length());
  for (Problem* const of : {&tall, &fast}) {
    of->limits.entry_slope_angle = Range::fixed(entry);
    of->limits.exit_slope_angle = Range::fixed(exit);
  }
  const Optimum held = optimize(tall);
  const Optimum held_fast = optimize(fast);
  REQUIRE(held.centerline);
  REQUIRE(held_fast.centerline);
  CHECK(rubbed(tall, held) == Approx(loss).epsilon(1e-6));
  CHECK(rubbed(fast, held_fast) == Approx(loss).epsilon(1e-6));
  // Neither other slopes at the start: of each the least that there is.
  for (const double other : {entry - 0.05, entry + 0.05}) {
    Problem turned = tall;
    turned.limits.entry_slope_angle = Range::fixed(other);
    const Optimum one = optimize(turned);
    REQUIRE(one.centerline);
    CHECK(rubbed(turned, one) >= loss * (1.0 - 1e-7));
  }
}

TEST_CASE("laws: a finish beyond reach is beyond it for a ball, unless its own height helps") {
  CHECK(optimize(problem(2.0, 0.1, 0.2, 0.0, ball(0.02))).report.status == OptimizeStatus::infeasible);
  // (H + h (sqrt(1 + c^2) + c))/L > c: the theorem is silent.
  const Optimum near = optimize(problem(2.0, 0.399, 0.2, 0.0, ball(0.02)));
  if (near.centerline)
    CHECK(Motion(near.centerline, problem(2.0, 0.399, 0.2, 0.0, ball(0.02)).body).arrived());
}

// Where a lead-in holds the slope, each tenth of a degree costs some 1e-4 of the time, and the next one 1e-6 more.
TEST_CASE(
    "a start from rest straight down is found, for every body, in line with those a little less steep") {
  const auto time_at = [](const LawPtr& law, double degrees, double lead_in, double radius) {
    Problem task = problem(1.0, 1.0, law ? 0.01 : 0.2, 0.0, law);
    const double angle = Angle::from_degrees(degrees).radians();
    task.limits.entry_slope_angle = {angle, angle};
    task.limits.lead_in = lead_in;
    if (radius > 0.0) task.limits.smallest_valley_radius = radius;
    const Optimum found = optimize(task);
    CHECK(found.report.status == OptimizeStatus::optimal);
    const Motion ride(found.centerline, task.body, task.gravity);
    REQUIRE(ride.arrived());
    return ride.travel_time();
  };
  const LawPtr rider = std::make_shared<const Rider>(0.008);
  for (const LawPtr& law : {LawPtr{}, ball(0.008), rider}) {
    for (const double lead_in : {0.0, 0.2}) {
      for (const double radius : {0.1, 0.3}) {
        // The tighter one right from the start and the other behind a straight, elsewhere than in CI.
        if ((lead_in > 0.0) != (radius > 0.2) && !testing::thorough()) continue;
        CAPTURE(law ? std::string(law->kind()) : "sliding point", lead_in, radius);
        const double straight_down = time_at(law, 90.0, lead_in, radius);
        const double steep = time_at(law, 89.9, lead_in, radius);
        const double less_steep = time_at(law, 89.8, lead_in, radius);
        CHECK(straight_down == Approx(steep + (steep - less_steep)).epsilon(3e-6));
      }
    }
  }
}

}  // namespace laws_test
