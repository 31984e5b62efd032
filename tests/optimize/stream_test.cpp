// Limits and objectives of a stream of bulk solid, each against a problem that asks for the same in other words.

#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/motion/laws/bulk_stream.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/ore.hpp"
#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace stream_test {

using namespace glissade;
using testing_problems::ore;
using testing_problems::solved;

namespace {

const BulkStream& stream_of(const Problem& problem) {
  return dynamic_cast<const BulkStream&>(*problem.body.law);
}

const LimitCheck& check_of(const Optimum& optimum, LimitId id) {
  for (const LimitCheck& check : optimum.report.checks) {
    if (check.limit.id == id) return check;
  }
  FAIL("the limit was not checked");
  return optimum.report.checks.front();
}

/// The integral of (u/u0 - 1)^2 along a track [m], summed up over the ride alone.
double unevenness(const Problem& problem, const Optimum& optimum) {
  constexpr int kParts = 4000;
  const Motion motion(optimum.centerline, problem.body);
  REQUIRE(motion.arrived());
  const double step = motion.distance() / kParts;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double uneven = motion.at((i + 0.5) * step).speed / problem.body.entry_speed - 1.0;
    sum += uneven * uneven * step;
  }
  return sum;
}

}  // namespace

TEST_CASE("streams: a highest burden depth is the lowest speed that it stands for") {
  Problem by_depth = ore(4.3, 3.2, 2.0);
  by_depth.limits.exit_slope_angle = Range::fixed(0.1);
  const double free_time = solved(by_depth).report.travel_time;
  // Deepest at the finish of the unlimited track, where the flat end slows it down.
  Problem by_speed = by_depth;
  by_depth.limits.highest_burden_depth = 0.0722;
  by_speed.limits.speed.lowest = stream_of(by_depth).depth(0.0, 1.0) / 0.0722;
  const Optimum a = solved(by_depth);
  const Optimum b = solved(by_speed);
  CHECK(a.report.travel_time == Approx(b.report.travel_time).epsilon(1e-9));
  CHECK(a.report.travel_time >= free_time * (1.0 - 1e-9));
  const LimitCheck& check = check_of(a, LimitId::highest_burden_depth);
  CHECK(check.kept());
  CHECK(check.value == 0.0722);
}

TEST_CASE("streams: the wear of the floor is a load at one friction, and each friction's own over a range") {
  Problem by_wear = ore(4.3, 5.9, 2.5);
  const double per_load = stream_of(by_wear).floor_wear(0.0, by_wear.body.friction, 1.0);
  const double free_time = solved(by_wear).report.travel_time;
  double before = std::numeric_limits<double>::infinity();
  for (const double load : {9.0, 10.0, 12.0}) {
    if (load == 10.0 && !testing::thorough()) continue;
    Problem by_load = by_wear;
    by_load.limits.highest_floor_wear.reset();
    by_load.limits.highest_normal_load = load;
    by_wear.limits.highest_floor_wear = per_load * load;
    const Optimum a = solved(by_wear);
    const Optimum b = solved(by_load);
    CHECK(a.report.travel_time == Approx(b.report.travel_time).epsilon(1e-5));
    CHECK(check_of(a, LimitId::highest_floor_wear).reached <= per_load * load * (1.0 + 1e-6));
    // Relaxed it is never slower, and never faster than without.
    CHECK(a.report.travel_time <= before * (1.0 + 1e-9));
    CHECK(a.report.travel_time >= free_time * (1.0 - 1e-9));
    before = a.report.travel_time;
    REQUIRE(a.report.active.size() >= 1);
    CHECK(a.report.active.front().price > 0.0);
  }
  by_wear.low_friction = Friction::from_coefficient(0.4);
  by_wear.high_friction = Friction::from_coefficient(0.6);
  const Optimum over_range = solved(by_wear);
  for (const double mu : {0.4, 0.5, 0.6}) {
    Body body = by_wear.body;
    body.friction = Friction::from_coefficient(mu);
    const Motion motion(over_range.centerline, body);
    const double wear = stream_of(by_wear).floor_wear(0.0, body.friction, motion.highest_load().normal_load);
    CHECK(wear <= *by_wear.limits.highest_floor_wear * (1.0 + 1e-5));
  }
}

TEST_CASE("streams: a slope margin is a lowest slope angle above the highest friction") {
  Problem by_margin = ore(4.3, 3.6, 2.0);
  by_margin.high_friction = Friction::from_coefficient(0.6);
  Problem by_slope = by_margin;
  by_margin.limits.lowest_slope_margin = 0.08;
  by_slope.limits.slope_angle.lowest = std::atan(0.6) + 0.08;
  const Optimum a = solved(by_margin);
  CHECK(a.report.travel_time == Approx(solved(by_slope).report.travel_time).epsilon(1e-9));
  CHECK(check_of(a, LimitId::lowest_slope_margin).reached >= 0.08 - 1e-6);
}

TEST_CASE("streams: the most even speed is the constant-speed curve where there is one") {
  Problem problem = ore(4.3, 3.0, 4.0);
  problem.objective.kind = ObjectiveKind::even_speed;
  const Optimum even = solved(problem);
  const Motion motion(even.centerline, problem.body);
  REQUIRE(motion.arrived());
  for (int i = 0; i <= 20; ++i) {
    const double s = even.centerline->length() * i / 20.0;
    CHECK(motion.at(std::min(s, even.centerline->length())).speed == Approx(4.0).epsilon(0.02));
  }
  const double rubs = problem.body.friction.coefficient() * problem.body.law->resistance(0.0, 16.0).factor;
  const ConstantSpeedCurve curve(problem.endpoints, Friction::from_coefficient(rubs), problem.gravity, 16.0);
  CHECK(even.centerline->length() == Approx(curve.length()).epsilon(0.01));
}

TEST_CASE("streams: prices of the most even speed are metres of the integral that it makes least") {
  // Of tracks with the bound a little higher and a little lower.
  Problem problem = ore(4.3, 5.9, 2.5);
  problem.objective.kind = ObjectiveKind::even_speed;
  problem.limits.smallest_valley_radius = 2.0;
  problem.limits.smallest_crest_radius = 2.0;
  problem.limits.slope_angle.highest = 1.05;
  const Optimum even = solved(problem);
  const auto& active = even.report.active;
  const auto slope = std::find_if(active.begin(), active.end(), [](const ActiveLimit& limit) {
    return limit.limit.id == LimitId::slope_angle;
  });
  REQUIRE(slope != active.end());
  CHECK(unit_of(problem.objective) == "m");
  if (!testing::thorough()) return;  // some seconds
  const auto at = [&](double highest) {
    Problem other = problem;
    other.limits.slope_angle.highest = highest;
    return unevenness(other, solved(other));
  };
  constexpr double kStep = 0.004;
  const double won = (at(1.05 - kStep) - at(1.05 + kStep)) / (2.0 * kStep);
  CAPTURE(won, slope->price, slope->price_error);
  CHECK(slope->price == Approx(won).epsilon(0.05));
}

TEST_CASE(
    "streams: the most even speed is found among many ways to bend: no further limit makes a track more "
    "even") {
  StreamShape shape;
  shape.mass_flow = 9.3;
  shape.bulk_density = 1000.0;
  shape.width = 0.5;
  shape.wall_height = 0.4;
  Problem problem;
  problem.endpoints = {11.92, 12.99};
  problem.body.friction = Friction::from_coefficient(0.48);
  problem.body.entry_speed = 4.37;
  problem.body.law = std::make_shared<const BulkStream>(shape);
  problem.objective.kind = ObjectiveKind::even_speed;
  problem.limits.slope_angle = {0.307, 1.019};
  problem.limits.entry_slope_angle.highest = 0.905;
  problem.limits.exit_slope_angle = {0.828, 1.019};
  problem.limits.smallest_valley_radius = 2.84;
  problem.limits.highest_curvature_rate = 0.0149;
  problem.limits.half_planes = {{{0.0, 1.788}, {-11.4404, 11.92}}};
  const double least = unevenness(problem, solved(problem));
  // What a search came to that began at no other track than a gently sagging one: 25.63.
  CHECK(least == Approx(25.295).epsilon(1e-4));
  const auto is_no_better = [&](const Problem& tighter) {
    CHECK(unevenness(tighter, solved(tighter)) >= least * (1.0 - 1e-5));
  };
  Problem steeper = problem;
  steeper.limits.exit_slope_angle.lowest = 0.905;
  is_no_better(steeper);
  if (!testing::thorough()) return;
  Problem slower = problem;
  slower.limits.highest_curvature_rate = 0.014;
  is_no_better(slower);
}

TEST_CASE("streams: the least wear is what arrives with the most, and rubs less than the fastest track") {
  Problem problem = ore(4.3, 5.9, 2.5);
  problem.limits.slope_angle.lowest = 0.6;
  problem.limits.concave = true;
  const Motion fastest(solved(problem).centerline, problem.body);
  problem.objective.kind = ObjectiveKind::least_wear;
  const Motion gentle(solved(problem).centerline, problem.body);
  problem.objective.kind = ObjectiveKind::exit_speed;
  const Motion swift(solved(problem).centerline, problem.body);
  const auto rubbed = [](const Motion& motion) { return motion.at(motion.distance()).friction_loss; };
  CHECK(rubbed(gentle) <= rubbed(fastest));
  CHECK(rubbed(gentle) == Approx(rubbed(swift)).epsilon(1e-9));
  CHECK(gentle.travel_time() >= fastest.travel_time() * (1.0 - 1e-9));
}

TEST_CASE("streams: a search keeps a stream from choking, and says so where it cannot") {
  Problem problem = ore(4.3, 2.3, 1.2);
  StreamShape shape = stream_of(problem).shape();
  shape.mass_flow = 2000.0 / 3.6;
  shape.wall_height = 0.45;
  problem.body.law = std::make_shared<const BulkStream>(shape);
  problem.body.friction = Friction::from_coefficient(0.45);
  const Optimum found = optimize(problem);
  if (found.centerline) {
    CHECK(Motion(found.centerline, problem.body).arrived());
  }
  problem.body.friction = Friction::from_coefficient(0.7);
  const Optimum none = optimize(problem);
  CHECK_FALSE(none.centerline);
}

}  // namespace stream_test
