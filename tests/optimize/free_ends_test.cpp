// Tracks with a free end: how low, how short, how gentle one can be that gives a body a certain speed.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/conflicts/mean_slope.hpp"
#include "optimize/least_bound/bound_bracket.hpp"
#include "optimize/problem/changed_bound.hpp"
#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace free_ends_test {

using namespace glissade;
using namespace glissade::optimizer;
using testing_problems::drop_of;
using testing_problems::solved;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kGravity = 9.81;

/// A body that is to leave an in-run at a speed, from wherever it has to start.
Problem task(double mu, double drag, double speed, ObjectiveKind objective) {
  Problem problem;
  problem.gravity = kGravity;
  problem.body.friction = Friction::from_coefficient(mu);
  problem.body.drag_per_metre = drag;
  problem.finish.kind = FinishKind::anywhere;
  problem.objective.kind = objective;
  problem.limits.exit_speed.lowest = speed;
  return problem;
}

/// An in-run of a large hill: a straight of at most 35 deg, a bend that grows and fades, a table.
Problem in_run(ObjectiveKind objective) {
  Problem problem = task(0.03, 0.0013, 27.0, objective);
  Limits& limits = problem.limits;
  limits.slope_angle.highest = 35.0 * kDegree;
  limits.exit_slope_angle = Range::fixed(11.0 * kDegree);
  limits.highest_curvature_rate = 6e-4;
  limits.lead_out = 6.9;
  limits.concave = true;
  return problem;
}

double rate_of(const Centerline& track) {
  double rate = 0.0;
  for (const ClothoidSegment& piece : dynamic_cast<const ClothoidSpline&>(track).segments()) {
    rate = std::max(rate, std::fabs(piece.exit_curvature - piece.entry_curvature) / piece.length);
  }
  return rate;
}

double price_of(const Optimum& optimum, LimitId id) {
  for (const ActiveLimit& active : optimum.report.active) {
    if (active.limit.id == id) return active.price;
  }
  return 0.0;
}

/// The in-run's shape worked out by hand: a straight, a curvature that grows and fades at its highest rate, a table. Its
/// bend turns by rate l^2, l the length of either half; only the straight is left to be found.
double hand_drop(const Problem& problem) {
  const Limits& limits = problem.limits;
  const double turn = *limits.slope_angle.highest - *limits.exit_slope_angle.lowest;
  const double half = std::sqrt(turn / *limits.highest_curvature_rate);
  const double most = *limits.highest_curvature_rate * half;
  const auto track = [&](double straight) {
    return std::make_shared<const ClothoidSpline>(
        Angle::from_radians(*limits.slope_angle.highest),
        std::vector<ClothoidSegment>{
            {straight, 0.0, 0.0}, {half, 0.0, most}, {half, most, 0.0}, {limits.lead_out, 0.0, 0.0}});
  };
  double low = 1.0;
  double high = 500.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const double speed = Motion(track(middle), problem.body, problem.gravity).exit_speed();
    (speed < *limits.exit_speed.lowest ? low : high) = middle;
  }
  return track(0.5 * (low + high))->endpoints().drop;
}

}  // namespace

// A crest would take load off the track, and friction with it: without `concave` the lowest track begins flatter.
TEST_CASE(
    "under a highest slope, without a crest, the lowest and the shortest track is that slope, straight") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 4; ++i) {
    const double mu = random.between(0.02, 0.4);
    const double slope = random.between(std::atan(mu) + 0.15, 1.2);
    const double speed = random.between(3.0, 30.0);
    CAPTURE(mu, slope, speed);
    const double pull = std::sin(slope) - mu * std::cos(slope);
    const double length = speed * speed / (2.0 * kGravity * pull);
    Problem problem = task(mu, 0.0, speed, ObjectiveKind::least_drop);
    problem.limits.slope_angle.highest = slope;
    problem.limits.concave = true;
    const Optimum lowest = solved(problem);
    CHECK(std::fabs(drop_of(lowest) / (length * std::sin(slope)) - 1.0) < 1e-6);
    // d(drop)/d(speed) and d(drop)/d(slope), drop = u^2/(2 g (1 - mu cot(slope)))
    const double share = 1.0 - mu / std::tan(slope);
    const double by_speed = speed / (kGravity * share);
    CHECK(std::fabs(price_of(lowest, LimitId::exit_speed) / by_speed - 1.0) < 1e-4);
    const double by_slope = 0.5 * speed * speed / kGravity * mu / std::pow(std::sin(slope) * share, 2.0);
    CHECK(std::fabs(price_of(lowest, LimitId::slope_angle) / by_slope - 1.0) < 1e-3);
    problem.objective.kind = ObjectiveKind::least_length;
    CHECK(std::fabs(solved(problem).centerline->length() / length - 1.0) < 1e-6);
  }
}

TEST_CASE(
    "the lowest in-run is the one worked out by hand, and the highest speed from its height is its speed") {
  const Problem problem = in_run(ObjectiveKind::least_drop);
  const Optimum lowest = solved(problem);
  const double by_hand = hand_drop(problem);
  CAPTURE(drop_of(lowest), by_hand);
  CHECK(drop_of(lowest) < by_hand * (1.0 + 1e-7));
  CHECK(drop_of(lowest) > by_hand * (1.0 - 1e-4));

  Problem fastest = in_run(ObjectiveKind::exit_speed);
  fastest.limits.exit_speed = {};
  fastest.finish.kind = FinishKind::level;
  fastest.endpoints = {0.0, drop_of(lowest)};
  CHECK(std::fabs(solved(fastest).report.exit_speed / 27.0 - 1.0) < 1e-6);
}

TEST_CASE("the price of a limit in drop is what the drop changes by") {
  Problem problem = in_run(ObjectiveKind::least_drop);
  const Optimum lowest = solved(problem);
  const double step = 6e-6;
  problem.limits.highest_curvature_rate = 6e-4 + step;
  const double looser = drop_of(solved(problem));
  problem.limits.highest_curvature_rate = 6e-4 - step;
  const double tighter = drop_of(solved(problem));
  const double measured = (tighter - looser) / (2.0 * step);
  CHECK(std::fabs(price_of(lowest, LimitId::highest_curvature_rate) / measured - 1.0) < 2e-3);
}

TEST_CASE("the price of a straight end is what the drop or the length changes by") {
  for (const ObjectiveKind kind : {ObjectiveKind::least_drop, ObjectiveKind::least_length}) {
    CAPTURE(static_cast<int>(kind));
    Problem problem = in_run(kind);
    problem.limits.lead_in = 5.0;
    const Optimum best = solved(problem);
    const auto measure_with = [&](double by) {
      Problem changed = problem;
      changed.limits.lead_out += by;
      const Optimum there = solved(changed);
      return kind == ObjectiveKind::least_drop ? drop_of(there) : there.centerline->length();
    };
    constexpr double kStep = 0.05;
    const double measured = (measure_with(kStep) - measure_with(-kStep)) / (2.0 * kStep);
    CHECK(price_of(best, LimitId::lead_out) == Approx(measured).epsilon(1e-3));
    CHECK(best.report.finer_mesh_wins.value() < 1e-6);
  }
}

TEST_CASE("a nearer end that is allowed never asks for a higher start") {
  // Between drag and hardly any friction low tracks are of two kinds, short ones and slow ones over a crest. Told as the lowest were 1.0964 m
  // with x from 5 m where 0.9890 m do, and 1.9745 m with x from 5.45 m where 1.9564 m do.
  struct Case {
    double friction, drag, entry, exit, valley, crest, steepest, exit_angle;
    std::vector<double> nearest;
  };
  for (const Case& one :
       {Case{5e-3, 0.003, 8.0, 9.0, 5.0, 8.0, 60.0, 14.0, {4.99, 5.0, 5.01, 6.0, 8.0, 12.0}},
        Case{0.0, 0.00395, 6.514, 8.869, 1.02, 2.78, 70.0, 7.0, {5.45, 6.8}},
        Case{0.0, 0.002957, 8.0654, 8.8689, 5.097, 7.841, 63.55, 13.84, {9.2, 11.0}}}) {
    Problem problem = task(one.friction, one.drag, one.exit, ObjectiveKind::least_drop);
    problem.body.entry_speed = one.entry;
    problem.limits.smallest_valley_radius = one.valley;
    problem.limits.smallest_crest_radius = one.crest;
    problem.limits.slope_angle.highest = one.steepest * kDegree;
    problem.limits.exit_slope_angle = Range::fixed(one.exit_angle * kDegree);
    double before = 0.0;
    for (const double nearest : one.nearest) {
      // Elsewhere than in CI the first two, which were out of order.
      if ((one.drag != 0.003 || nearest > 5.0) && !testing::thorough()) continue;
      CAPTURE(one.drag, nearest, before);
      problem.finish.free_range.lowest = nearest;
      const double drop = drop_of(solved(problem));
      // What a track all but plumb loses to a mesh, which its report tells.
      constexpr double kOfMesh = 5e-5;
      CHECK(drop > (1.0 - kOfMesh) * before);
      before = drop;
    }
  }
}

TEST_CASE("a limit that is relaxed never asks for a higher start") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const Problem problem = in_run(ObjectiveKind::least_drop);
  const double before = drop_of(solved(problem));
  const double by = random.between(1.02, 1.3);
  for (int which = 0; which < 3; ++which) {
    CAPTURE(which, by);
    Problem relaxed = problem;
    Limits& limits = relaxed.limits;
    if (which == 0) *limits.slope_angle.highest *= by;
    if (which == 1) *limits.highest_curvature_rate *= by;
    if (which == 2) limits.exit_speed.lowest = 27.0 / by;
    CHECK(drop_of(solved(relaxed)) < before * (1.0 + 1e-7));
  }
}

TEST_CASE(
    "a lower speed asked for at an end that lies far off is never out of reach, nor is the track longer") {
  testing::Random random = testing::seeded_random(20250409);
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < (testing::thorough() ? 12 : 2); ++i) {
    for (const FinishKind kind : {FinishKind::anywhere, FinishKind::vertical_line, FinishKind::level}) {
      Problem problem;
      problem.gravity = kGravity;
      problem.body.friction = Friction::from_coefficient(random.between(0.02, 0.1));
      problem.body.entry_speed = random.between(0.0, 1.0) < 0.5 ? 0.0 : 1.0;
      problem.objective.kind =
          random.between(0.0, 1.0) < 0.5 ? ObjectiveKind::least_length : ObjectiveKind::travel_time;
      problem.finish.kind = kind;
      // Far off in the coordinate that is given or bounded, next to the start in the other one.
      const double run = kind == FinishKind::vertical_line ? 0.3 : random.between(5.0, 10.0);
      const double drop = kind == FinishKind::level ? 1.5 : random.between(8.0, 12.0);
      problem.endpoints = {run, drop};
      if (kind == FinishKind::anywhere) problem.finish.free_drop = {drop, drop + 2.0};
      problem.finish.free_range =
          kind == FinishKind::vertical_line ? Range{drop, drop + 2.0} : Range{run, run + 2.0};
      double before = HUGE_VAL;
      for (const double speed : {5.0, 3.5, 2.0, 1.1}) {
        // Down to a level the longer runs are slow.
        if (kind == FinishKind::level && speed > 3.0) continue;
        problem.limits.exit_speed.lowest = speed;
        const Optimum optimum = optimize(problem);
        CAPTURE(i, static_cast<int>(kind), run, drop, speed, optimum.report.brief());
        REQUIRE(optimum.centerline);
        CHECK(optimum.report.status == OptimizeStatus::optimal);
        const bool shortest = problem.objective.kind == ObjectiveKind::least_length;
        const double size = shortest ? optimum.centerline->length() : optimum.report.travel_time;
        CHECK(size <= before * (1.0 + 1e-6));
        if (shortest && kind == FinishKind::anywhere) CHECK(size <= std::hypot(run, drop) * (1.0 + 1e-6));
        before = size;
      }
    }
  }
}

TEST_CASE("bounds that keep an end away say how far it is, where no speed is asked for that does") {
  Problem problem;
  problem.gravity = kGravity;
  problem.body.friction = Friction::from_coefficient(0.1);
  problem.body.entry_speed = 5.0;
  problem.finish.kind = FinishKind::anywhere;
  problem.finish.free_range = {10.0, 12.0};
  problem.finish.free_drop = {4.0, 6.0};
  const double without = solved(problem).report.travel_time;
  for (const double speed : {4.99, 5.01}) {
    problem.limits.exit_speed.lowest = speed;
    CHECK(std::fabs(solved(problem).report.travel_time / without - 1.0) < 1e-6);
  }
  problem.limits.exit_speed.lowest.reset();
  problem.finish.free_range = {0.0, 12.0};
  problem.finish.free_drop = {-1.0, 6.0};
  CHECK_THROWS_WITH(optimize(problem), Catch::Matchers::Contains("free both ways"));
}

TEST_CASE("a wind from behind drives a body from rest up to a finish above the start") {
  Problem problem;
  problem.gravity = kGravity;
  problem.body.friction = Friction::from_coefficient(0.1);
  problem.body.drag_per_metre = 0.1;
  problem.body.head_wind = -20.0;
  double before = 0.0;
  for (const double climb : {-0.5, 0.0, 1.0}) {
    CAPTURE(climb);
    problem.endpoints = {10.0, -climb};
    const Optimum fastest = solved(problem);
    const double slope = std::atan2(-climb, 10.0);
    const auto line = std::make_shared<const ClothoidSpline>(
        Angle::from_radians(slope), std::vector<ClothoidSegment>{{std::hypot(10.0, climb), 0.0, 0.0}});
    const Motion straight(line, problem.body, kGravity);
    REQUIRE(straight.arrived());
    CHECK(fastest.report.travel_time < straight.travel_time());
    CHECK(fastest.report.travel_time > 0.95 * straight.travel_time());
    CHECK(fastest.report.travel_time > before);
    before = fastest.report.travel_time;
  }
  problem.body.head_wind = 20.0;
  CHECK_THROWS_WITH(optimize(problem),
                    Catch::Matchers::Contains("from rest the finish must lie below the start"));
}

TEST_CASE("a speed that a wind from behind gives asks for no drop, nor for a longer track") {
  Problem problem = task(0.1, 0.5, 50.0, ObjectiveKind::least_length);
  problem.body.head_wind = -60.0;
  problem.finish.free_range = {10.0, 12.0};
  problem.finish.free_drop = {1.0, 2.0};
  const Optimum shortest = solved(problem);
  CHECK(std::fabs(shortest.centerline->length() / std::hypot(10.0, 1.0) - 1.0) < 1e-6);
  CHECK(shortest.report.exit_speed > 50.0);
}

TEST_CASE("of a run of a foot a fall of forty is no more than others") {
  Problem problem = task(0.1, 0.0, 20.0, ObjectiveKind::travel_time);
  problem.finish.kind = FinishKind::vertical_line;
  problem.endpoints = {0.5, 0.0};
  const Optimum fastest = solved(problem);
  // No track has less than the drop of free fall, and none is faster than that.
  const double fall = 20.0 * 20.0 / (2.0 * kGravity);
  CHECK(drop_of(fastest) > fall);
  CHECK(drop_of(fastest) < 1.01 * fall);
  CHECK(fastest.report.travel_time > std::sqrt(2.0 * fall / kGravity));
  CHECK(fastest.report.travel_time < 1.01 * std::sqrt(2.0 * fall / kGravity));
}

TEST_CASE("a least load that limits on shape hold up is the same for whatever lower speed is asked for") {
  Problem problem = task(0.03, 0.0013, 27.05, ObjectiveKind::least_load);
  problem.finish.kind = FinishKind::point;
  problem.endpoints = {90.0, 47.104};
  Limits& limits = problem.limits;
  limits.slope_angle.highest = 35.0 * kDegree;
  limits.exit_slope_angle = Range::fixed(11.0 * kDegree);
  limits.concave = true;
  limits.smallest_valley_radius = 104.1;
  limits.lead_in = 24.0;
  limits.lead_out = 6.767;
  // By descents of its own it is 15.0331; it was told as 15.0354 m/s^2 where the speed was all but reached.
  const auto least_for = [&](double speed) {
    problem.limits.exit_speed.lowest = speed;
    const Optimum least = solved(problem);
    CHECK(least.report.message == "every limit holds, and no track keeps a tighter bound");
    // Central differences of re-solves 0.2 deg, 0.2 m to either side.
    CHECK(std::fabs(price_of(least, LimitId::slope_angle) * kDegree / 0.608 - 1.0) < 0.05);
    CHECK(std::fabs(price_of(least, LimitId::lead_out) / 0.2717 - 1.0) < 0.02);
    return Motion(least.centerline, problem.body, kGravity).highest_load().normal_load;
  };
  if (!testing::thorough()) return;  // each takes seconds
  CHECK(std::fabs(least_for(26.8) / 15.0331 - 1.0) < 1e-5);
  CHECK(std::fabs(least_for(26.0) / 15.0331 - 1.0) < 1e-5);
  CHECK(std::fabs(least_for(27.05) / 15.0331 - 1.0) < 1e-5);
}

namespace {

/// Holds a least bound against tracks of another objective: one keeps a little more, and none a little less.
void check_is_least(Problem problem, double least) {
  std::optional<double>& bound = problem.objective.kind == ObjectiveKind::least_load
                                     ? problem.limits.highest_normal_load
                                     : problem.limits.highest_curvature_rate;
  problem.objective.kind = ObjectiveKind::travel_time;
  bound = least * 1.001;
  CHECK(optimize(problem).centerline != nullptr);
  bound = least * 0.999;
  CHECK(optimize(problem).centerline == nullptr);
}

}  // namespace

TEST_CASE("the least highest load, kept as a limit, needs just the height that it was found from") {
  if (!testing::thorough())
    return;  // many seconds; the least rate of curvature below stands for it elsewhere
  Problem gentle = in_run(ObjectiveKind::least_load);
  gentle.finish.kind = FinishKind::level;
  const double height = drop_of(solved(in_run(ObjectiveKind::least_drop))) + 0.2;
  gentle.endpoints = {0.0, height};
  const Optimum least = solved(gentle);
  CHECK(std::fabs(least.report.exit_speed - 27.0) < 1e-6);
  const double load = Motion(least.centerline, gentle.body, kGravity).highest_load().normal_load;
  CHECK(load < 1.8 * kGravity);
  CHECK(least.report.message.find("tighter bound") != std::string::npos);

  Problem lowest = in_run(ObjectiveKind::least_drop);
  lowest.limits.highest_normal_load = load;
  const Optimum other = solved(lowest);
  CHECK(std::fabs(drop_of(other) / height - 1.0) < 1e-5);
  // How the load answers to the speed is the price of the one over that of the other. Re-solves 0.003 m/s and 0.003 m/s^2 to
  // either side say 28.17; the prices here 28.26 and, where the mesh of the lowest track is coarser, 27.93.
  const double by_speed = price_of(least, LimitId::exit_speed);
  const double expected =
      price_of(other, LimitId::exit_speed) / price_of(other, LimitId::highest_normal_load);
  CHECK(std::fabs(by_speed / expected - 1.0) < 2e-2);
  // That no track keeps less is known by the height, and by another search.
  check_is_least(gentle, load);
}

TEST_CASE("the least rate of curvature, kept as a limit, needs just the height that it was found from") {
  Problem gentle = in_run(ObjectiveKind::least_curvature_rate);
  gentle.limits.highest_curvature_rate.reset();
  gentle.finish.kind = FinishKind::level;
  const Problem lowest = in_run(ObjectiveKind::least_drop);
  gentle.endpoints = {0.0, drop_of(solved(lowest))};
  const Optimum least = solved(gentle);
  CHECK(std::fabs(rate_of(*least.centerline) / *lowest.limits.highest_curvature_rate - 1.0) < 1e-3);
}

TEST_CASE("a search that comes to no end proves nothing of a bound") {
  Bracket bracket;
  bracket.loose = 20.0;
  bracket.learn(10.0, Verdict::too_slow);
  bracket.learn(19.0, Verdict::untold);
  CHECK(bracket.tight == 10.0);
  CHECK(bracket.floor() == 19.0);
  bracket.learn(19.0 + 1e-8, Verdict::does);
  CHECK(bracket.is_closed());
  CHECK_FALSE(bracket.untold.empty());  // closed, but on a bound of which nothing is known
  SECTION("a tighter bound that does answers for it") {
    bracket.learn(15.0, Verdict::does);
    CHECK(bracket.untold.empty());
    CHECK(bracket.loose == 15.0);
    CHECK(bracket.floor() == 10.0);
    CHECK_FALSE(bracket.is_closed());
  }
  SECTION("so does a looser one that does not") {
    bracket.learn(19.0, Verdict::kept_by_none);
    CHECK(bracket.untold.empty());
    CHECK(bracket.is_closed());
  }
}

TEST_CASE("a least load that the slope of the table alone asks for is told as one that no track goes below") {
  Problem problem = in_run(ObjectiveKind::least_load);
  problem.finish.kind = FinishKind::level;
  problem.endpoints = {0.0, 46.0};
  problem.limits.exit_speed.lowest = 20.0;  // straight down the slope of the table gives 24 m/s
  const Optimum least = solved(problem);
  CHECK(least.report.message == "every limit holds, and no track carries less than the straight line");
  const double load = Motion(least.centerline, problem.body, kGravity).highest_load().normal_load;
  CHECK(std::fabs(load / (kGravity * std::cos(11.0 * kDegree)) - 1.0) < 1e-5);
  // Where no straight line will do, too, a speed that is exceeded holds nothing back, and has no price.
  problem.limits.entry_slope_angle.lowest = 15.0 * kDegree;
  OptimizeOptions options;
  options.time_budget = testing::thorough() ? 2.0 : 0.5;
  const Optimum bent = optimize(problem, options);
  REQUIRE(bent.centerline);
  CHECK(bent.report.exit_speed > 20.1);
  CHECK(price_of(bent, LimitId::exit_speed) == 0.0);
}

namespace {

/// From one point to another, to a speed that the straight line between them reaches.
Problem between_points(ObjectiveKind objective) {
  Problem problem;
  problem.gravity = kGravity;
  problem.endpoints = {10.0, 6.0};
  problem.body.friction = Friction::from_angle(Angle::from_degrees(11.0));
  problem.objective.kind = objective;
  problem.limits.exit_speed.lowest = 7.0;
  return problem;
}

void check_is_straight(const Optimum& least) {
  REQUIRE(least.centerline != nullptr);
  CHECK(least.report.status == OptimizeStatus::optimal);
  CHECK(least.report.evaluations == 0);  // it is known, not searched for
  const Endpoints end = least.centerline->endpoints();
  CHECK(std::fabs(least.centerline->length() / std::hypot(end.run, end.drop) - 1.0) < 1e-12);
  CHECK(least.report.active.empty());
  for (const LimitCheck& check : least.report.checks) {
    CAPTURE(check.limit.key());
    CHECK(check.kept());
  }
}

}  // namespace

TEST_CASE(
    "from rest no track carries less at its most than the straight line: where that will do it is the "
    "answer") {
  Problem problem = between_points(ObjectiveKind::least_load);
  problem.limits.smallest_crest_radius = 4.0;
  problem.limits.smallest_valley_radius = 4.0;
  const Optimum least = solved(problem);
  check_is_straight(least);
  CHECK(least.report.message == "every limit holds, and no track carries less than the straight line");
  const double load = Motion(least.centerline, problem.body, kGravity).highest_load().normal_load;
  CHECK(std::fabs(load / (kGravity * std::cos(std::atan2(6.0, 10.0))) - 1.0) < 1e-12);
  // u^2 = 2 g (drop - mu run)
  const double fall = 6.0 - 10.0 * std::tan(11.0 * kDegree);
  CHECK(std::fabs(least.report.exit_speed / std::sqrt(2.0 * kGravity * fall) - 1.0) < 1e-9);
}

TEST_CASE("a body that enters fast may carry less over a crest than on the straight line") {
  Problem problem = between_points(ObjectiveKind::least_load);
  problem.body.entry_speed = 4.0;
  CHECK(least_load_anywhere(problem) == 0.0);
  problem.limits.concave = true;  // without a crest it may not
  CHECK(std::fabs(least_load_anywhere(problem) / (kGravity * std::cos(std::atan2(6.0, 10.0))) - 1.0) < 1e-12);
  check_is_straight(solved(problem));
}

TEST_CASE("no track carries less than what every track is said to carry") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int problems = testing::thorough() ? 400 : 60;
  int told = 0;
  for (int i = 0; i < problems; ++i) {
    Problem problem;
    problem.gravity = kGravity;
    problem.body.entry_speed = i % 2 == 0 ? 0.0 : random.between(0.5, 6.0);
    problem.limits.concave = i % 3 == 0;
    // Any track: a straight, a bend to either side, a straight.
    const double entry = random.between(i % 2 == 0 ? 0.2 : -0.5, 1.4);
    const double turn = problem.limits.concave ? random.between(-1.5, 0.0) : random.between(-1.5, 1.5);
    const double exit = std::clamp(entry + turn, -1.4, 1.4);
    const double bend = random.between(0.5, 4.0);
    const double lead_in = random.between(0.1, 4.0);
    const double lead_out = random.between(0.1, 4.0);
    const double curvature = (entry - exit) / bend;
    const auto track = std::make_shared<const ClothoidSpline>(
        Angle::from_radians(entry),
        std::vector<ClothoidSegment>{
            {lead_in, 0.0, 0.0}, {bend, curvature, curvature}, {lead_out, 0.0, 0.0}});
    problem.endpoints = track->endpoints();
    if (!(problem.endpoints.run > 0.1)) continue;
    if (i % 5 == 0) problem.limits.lead_in = lead_in;
    if (i % 7 == 0) problem.limits.lead_out = lead_out;
    if (i % 4 == 0) problem.finish.kind = FinishKind::level;
    if (i % 4 == 0) problem.limits.slope_angle.highest = std::max(entry, exit);
    const Endpoints ends = problem.endpoints;
    if (i % 8 == 0)
      problem.finish.free_range = {random.between(0.5, 1.0) * ends.run, random.between(1.0, 2.0) * ends.run};
    if (i % 4 == 2) {
      problem.finish = {FinishKind::vertical_line,
                        {ends.drop - random.between(0.0, 3.0), ends.drop + random.between(0.0, 1.0)},
                        {}};
    }
    const Motion motion(track, problem.body, kGravity);
    if (!motion.arrived()) continue;
    const double least = least_load_anywhere(problem);
    CAPTURE(i, entry, exit, bend, lead_in, lead_out, problem.body.entry_speed);
    CHECK(motion.highest_load().normal_load >= least * (1.0 - 1e-9));
    if (least > 0.0) ++told;
  }
  CHECK(told > problems / 4);
}

TEST_CASE("the straight line, where it will do, has the least rate of curvature, none") {
  Problem problem = between_points(ObjectiveKind::least_curvature_rate);
  problem.limits.slope_angle.highest = 50.0 * kDegree;
  const Optimum least = solved(problem);
  check_is_straight(least);
  CHECK(rate_of(*least.centerline) == 0.0);
  CHECK(least.report.message ==
        "every limit holds, and the straight line has no curvature that could change");
  // So has one of the lines down to a level, or to a plumb line.
  for (const FinishKind kind : {FinishKind::level, FinishKind::vertical_line}) {
    problem.finish.kind = kind;
    const Optimum other = solved(problem);
    check_is_straight(other);
    CHECK(rate_of(*other.centerline) == 0.0);
    CHECK(other.report.exit_speed >= 7.0 * (1.0 - 1e-7));
  }
}

TEST_CASE("down to a level the steepest straight line that is allowed carries the least") {
  Problem problem = between_points(ObjectiveKind::least_load);
  problem.finish.kind = FinishKind::level;
  problem.limits.slope_angle.highest = 40.0 * kDegree;
  const Optimum least = solved(problem);
  check_is_straight(least);
  const double load = Motion(least.centerline, problem.body, kGravity).highest_load().normal_load;
  CHECK(std::fabs(load / (kGravity * std::cos(40.0 * kDegree)) - 1.0) < 1e-9);
}

TEST_CASE("of the straight lines to a free end the few that a cap on the speed leaves are found") {
  Problem problem = between_points(ObjectiveKind::least_load);
  problem.endpoints = {0.0, 2.395};
  problem.finish.kind = FinishKind::level;
  problem.body = {};
  problem.body.friction = Friction::from_coefficient(0.05);
  problem.low_friction = Friction::from_coefficient(0.035);
  problem.high_friction = Friction::from_coefficient(0.0675);
  problem.body.entry_speed = 2.843;
  problem.limits = {};
  problem.limits.exit_speed.lowest = 3.969;
  problem.limits.speed.highest = 6.057;
  OptimizeOptions options;
  options.time_budget = 0.3;
  const Optimum least = optimize(problem, options);
  REQUIRE(least.centerline);
  // The steepest is that on which the body just reaches the cap where friction is low: u^2 = u0^2 + 2 g (drop - mu run).
  const double run = (2.395 - (6.057 * 6.057 - 2.843 * 2.843) / (2.0 * kGravity)) / 0.035;
  const double load = kGravity * std::cos(std::atan2(2.395, run));
  CHECK(Motion(least.centerline, problem.body, kGravity).highest_load().normal_load <= load * (1.0 + 1e-6));
}

TEST_CASE("where higher and higher tracks carry less and less, no load is called the least") {
  Problem problem = between_points(ObjectiveKind::least_load);
  problem.finish.kind = FinishKind::vertical_line;
  const Optimum open = optimize(problem);
  REQUIRE(open.centerline);
  CHECK(open.report.status == OptimizeStatus::feasible_not_converged);
  CHECK(open.report.message ==
        "every limit holds, but there is no least load: the higher a track, the less it carries; bound the "
        "free height");
  for (const double highest : {20.0, 30.0}) {
    problem.finish.free_range.highest = highest;
    const Optimum bounded = solved(problem);
    CHECK(bounded.report.status == OptimizeStatus::optimal);
    CHECK(std::fabs(drop_of(bounded) / highest - 1.0) < 1e-6);
  }
}

TEST_CASE("a straight line that does not reach the speed is not the answer") {
  Problem problem = between_points(ObjectiveKind::least_load);
  problem.limits.exit_speed.lowest = 9.5;  // the straight line gives 8.92
  OptimizeOptions options;
  options.time_budget = testing::thorough() ? 1.0 : 0.1;
  const Optimum least = optimize(problem, options);
  CHECK(least.report.evaluations > 0);
  CHECK(least.report.message.find("straight line") == std::string::npos);
}

TEST_CASE("a least bound is one: by another way to it a track keeps a little more, and none a little less") {
  if (!testing::thorough()) return;  // each takes a second
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 7; ++i) {
    const double slope = random.between(28.0, 37.0) * kDegree;
    const double table = random.between(8.0, 12.0) * kDegree;
    const double speed = random.between(22.0, 28.0);
    const double above = random.between(1.005, 1.05);
    // Not the first, which takes twice as long as any other.
    if (i == 0) continue;
    const bool load = i % 2 == 0;
    Problem problem = in_run(load ? ObjectiveKind::least_load : ObjectiveKind::least_curvature_rate);
    problem.limits.slope_angle.highest = slope;
    problem.limits.exit_slope_angle = Range::fixed(table);
    problem.limits.exit_speed.lowest = speed;
    if (!load) problem.limits.highest_curvature_rate.reset();
    Problem lowest = problem;
    lowest.objective.kind = ObjectiveKind::least_drop;
    if (!load) lowest.limits.highest_curvature_rate = 6e-4;
    problem.finish.kind = FinishKind::level;
    problem.endpoints = {0.0, drop_of(solved(lowest)) * above};
    CAPTURE(i, problem.endpoints.drop);
    const Optimum least = solved(problem);
    check_is_least(problem, load ? Motion(least.centerline, problem.body, kGravity).highest_load().normal_load
                                 : rate_of(*least.centerline));
  }
}

namespace {

/// Between two points to a table, with more exit speed left than is asked for.
Problem down_to_table(ObjectiveKind objective) {
  Problem problem;
  problem.gravity = kGravity;
  problem.endpoints = {80.0, 40.0};
  problem.body.friction = Friction::from_coefficient(0.05);
  problem.limits.slope_angle = {5.0 * kDegree, 60.0 * kDegree};
  problem.limits.exit_slope_angle = Range::fixed(10.0 * kDegree);
  problem.limits.exit_speed.lowest = 22.0;
  problem.objective.kind = objective;
  return problem;
}

}  // namespace

TEST_CASE(
    "a least load that no track goes below, whatever its speed, takes no more searches than it has digits") {
  Problem problem = down_to_table(ObjectiveKind::least_load);
  const Optimum least = solved(problem);
  CHECK(least.report.message == "every limit holds, and no track keeps a tighter bound");
  CHECK(least.report.evaluations < 10000);  // 7,000; 23,600 where it is halved down to
  const double load = Motion(least.centerline, problem.body, kGravity).highest_load().normal_load;
  // What holds it up is told, and costs nothing in speed.
  CHECK(!least.report.active.empty());
  CHECK(price_of(least, LimitId::exit_speed) == 0.0);
  if (!testing::thorough()) return;
  for (const ActiveLimit& active : least.report.active) {
    const auto least_with = [&](double by) {
      const Problem changed = *optimizer::with_bound(problem, active.limit, active.value + by);
      const Optimum there = solved(changed);
      return Motion(there.centerline, changed.body, kGravity).highest_load().normal_load;
    };
    constexpr double kShare = 3e-3;
    const double step = kShare * std::fabs(active.value);
    const double measured = std::fabs(least_with(step) - least_with(-step)) / (2.0 * step);
    CAPTURE(active.limit.key(), measured);
    CHECK(active.price == Approx(measured).epsilon(0.02));
  }
  // Another way to it: what the fastest track may carry.
  problem.objective.kind = ObjectiveKind::travel_time;
  problem.limits.highest_normal_load = load * (1.0 + 1e-5);
  CHECK(optimize(problem).report.status == OptimizeStatus::optimal);
  problem.limits.highest_normal_load = load * (1.0 - 1e-5);
  CHECK(optimize(problem).report.status == OptimizeStatus::infeasible);
}

TEST_CASE("where an arc does, no rate of curvature is the least, and told as none") {
  const Problem problem = down_to_table(ObjectiveKind::least_curvature_rate);
  const Optimum least = solved(problem);
  CHECK(least.report.message ==
        "every limit holds on a track of one curvature, which has none that could change");
  CHECK(least.report.active.empty());
  // An arc turns as much to either side of its chord.
  const double chord = std::atan2(40.0, 80.0);
  CHECK(std::fabs(least.centerline->at(0.0).slope_angle - (2.0 * chord - 10.0 * kDegree)) < 1e-7);
}

TEST_CASE("a least bound that time ran out on is not called the least") {
  Problem problem = in_run(ObjectiveKind::least_load);
  problem.finish.kind = FinishKind::level;
  problem.endpoints = {0.0, 46.5};
  OptimizeOptions options;
  options.time_budget = 1e-3;
  const Optimum optimum = optimize(problem, options);
  CHECK(optimum.report.status != OptimizeStatus::optimal);
  CHECK(optimum.report.ended_early);
}

TEST_CASE("a speed that drag does not allow is infeasible, not a high tower") {
  Problem problem = in_run(ObjectiveKind::least_drop);
  problem.limits.exit_speed.lowest = 80.0;  // above sqrt(g (sin - mu cos)/k) = 64.4 m/s at 35 deg
  const Optimum optimum = optimize(problem);
  CHECK(optimum.centerline == nullptr);
  problem.objective.kind = ObjectiveKind::least_load;
  problem.finish.kind = FinishKind::level;
  problem.endpoints = {0.0, 46.0};
  const Optimum load = optimize(problem);
  CHECK(load.centerline == nullptr);
  CHECK(load.report.objective.kind == ObjectiveKind::least_load);
}

TEST_CASE("an end that is free both ways needs a speed to be reached, and a least bound an end that is not") {
  Problem problem = in_run(ObjectiveKind::least_drop);
  problem.limits.exit_speed = {};
  CHECK_THROWS_AS(optimize(problem), InputError);
  problem = in_run(ObjectiveKind::least_load);
  CHECK_THROWS_WITH(optimize(problem), contains_text("a longer and longer track"));
}

TEST_CASE("a drop that is given is no less for being made the least") {
  for (const FinishKind kind : {FinishKind::point, FinishKind::level}) {
    Problem problem = in_run(ObjectiveKind::least_drop);
    problem.finish.kind = kind;
    problem.endpoints = {90.0, 46.0};
    CHECK_THROWS_WITH(optimize(problem),
                      contains_text("objective: least_drop, of a finish whose drop is given") &&
                          contains_text("a finish whose drop is free"));
  }
}

TEST_CASE(
    "a straight ramp that keeps every limit is never higher than the lowest track, however long its ends") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int count = testing::thorough() ? 24 : 2;
  for (int i = 0; i < count; ++i) {
    const double mu = random.between(0.02, 0.35);
    const double speed = random.between(4.0, 25.0);
    const double fall = speed * speed / (2.0 * kGravity);
    Problem problem = task(mu, 0.0, speed, ObjectiveKind::least_drop);
    // Straight ends longer than the steepest ramp, and shorter ones.
    problem.limits.lead_out = random.between(0.1, 1.35) * fall;
    problem.limits.slope_angle.highest = random.between(62.0, 86.0) * kDegree;
    CAPTURE(mu, speed, problem.limits.lead_out, problem.limits.slope_angle.highest.value());
    const double steepest = *problem.limits.slope_angle.highest;
    const double pull = std::sin(steepest) - mu * std::cos(steepest);
    // 2 g S (sin(zeta) - mu cos(zeta)) = u^2, at the steepest slope or at the length of the straight end
    const double length = std::max(fall / pull, problem.limits.lead_out);
    const double delta = std::atan(mu);
    const double slope = length > fall / pull ? delta + std::asin(std::cos(delta) * fall / length) : steepest;
    const double by_hand = length * std::sin(slope);
    const Optimum lowest = solved(problem);
    CHECK(drop_of(lowest) < by_hand * (1.0 + 2e-7));
    CHECK(drop_of(lowest) > fall);
    // Relaxed it is no higher.
    problem.limits.slope_angle.highest = std::min(steepest + 3.0 * kDegree, 89.0 * kDegree);
    CHECK(drop_of(solved(problem)) < drop_of(lowest) * (1.0 + 2e-7));
  }
}

TEST_CASE("the highest exit speed to a free height is at its bound, however far, and none without one") {
  Problem problem;
  problem.endpoints = {10.0, 0.0};
  problem.finish.kind = FinishKind::vertical_line;
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.body.entry_speed = 1.0;
  problem.limits.smallest_valley_radius = 2.0;
  problem.limits.smallest_crest_radius = 2.0;
  problem.objective.kind = ObjectiveKind::exit_speed;
  for (const double deepest : {50.0, 305.0}) {
    problem.finish.free_range.highest = deepest;
    const Optimum found = solved(problem);
    INFO(deepest << " m");
    CHECK(drop_of(found) == Approx(deepest).epsilon(1e-6));
    const double straight = std::sqrt(1.0 + 2.0 * problem.gravity * (deepest - 0.2 * 10.0));
    CHECK(found.report.exit_speed >= straight);
    CHECK(price_of(found, LimitId::finish_drop) ==
          Approx(problem.gravity / found.report.exit_speed).epsilon(0.02));
  }
  // Beyond what is looked at, and without a bound, it says so.
  for (const std::optional<double> deepest : {std::optional(5000.0), std::optional<double>()}) {
    problem.finish.free_range.highest = deepest;
    const Optimum found = optimize(problem);
    CHECK(found.report.status == OptimizeStatus::feasible_not_converged);
    CHECK_THAT(found.report.message,
               Catch::Matchers::Contains("but the longer a track, the better: none longer than ") &&
                   Catch::Matchers::Contains("give the free end a nearer bound"));
  }
}

TEST_CASE("where a body can fly all the way the least load is next to none, and told at once") {
  // Tighter and tighter bounds were looked at, until time was over.
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 8; ++i) {
    Problem problem;
    problem.endpoints = {random.between(2.0, 50.0), random.between(1.0, 8.0)};
    problem.body.friction = Friction::from_coefficient(random.between(0.0, 0.3));
    problem.body.entry_speed = 30.0;
    // A body that flies leaves with all that the drop gives.
    const double flown = std::sqrt(900.0 + 2.0 * problem.gravity * problem.endpoints.drop);
    problem.limits.exit_speed.lowest = 0.9999 * flown;
    problem.objective.kind = ObjectiveKind::least_load;
    CAPTURE(i, problem.endpoints.run, problem.endpoints.drop, problem.body.friction.coefficient());
    const Optimum found = solved(problem);
    const Motion ride(found.centerline, problem.body, problem.gravity);
    CHECK(ride.highest_load().normal_load < 1e-5 * problem.gravity);
    CHECK(found.report.exit_speed == Approx(flown).epsilon(1e-6));
    CHECK_THAT(found.report.message,
               Catch::Matchers::Contains("on the path of a body that flies, which carries nothing"));
    CHECK(found.report.evaluations < 20'000);
  }
}

TEST_CASE("prices of a ramp are what its drop changes by") {
  if (!testing::thorough()) return;  // some seconds
  Problem problem = task(0.05, 0.0, 10.0, ObjectiveKind::least_drop);
  problem.limits.lead_out = 6.0;
  problem.limits.slope_angle.highest = 65.0 * kDegree;
  const Optimum lowest = solved(problem);
  CHECK(lowest.centerline->kind() == "straight");
  const auto drop_with = [&](double lead_out, double speed) {
    Problem changed = problem;
    changed.limits.lead_out = lead_out;
    changed.limits.exit_speed.lowest = speed;
    return drop_of(solved(changed));
  };
  // u^2 = 2 g (S sin(zeta) - mu S cos(zeta)), of a ramp of one length: the price of the speed by hand.
  const double length = lowest.centerline->length();
  const double slope = lowest.centerline->slope_angle(0.0);
  const double by_hand = 10.0 * std::cos(slope) / (kGravity * (std::cos(slope) + 0.05 * std::sin(slope)));
  CHECK(std::fabs(length - 6.0) < 1e-9);
  CHECK(std::fabs(price_of(lowest, LimitId::exit_speed) / by_hand - 1.0) < 1e-3);
  // From the shorter side alone, to the second order: a longer end takes a search.
  const double by_lead = (3.0 * drop_of(lowest) - 4.0 * drop_with(5.99, 10.0) + drop_with(5.98, 10.0)) / 0.02;
  CHECK(std::fabs(price_of(lowest, LimitId::lead_out) / by_lead - 1.0) < 1e-3);
  const double by_lead_both = (drop_with(6.01, 10.0) - drop_with(5.99, 10.0)) / 0.02;
  CHECK(std::fabs(price_of(lowest, LimitId::lead_out) / by_lead_both - 1.0) < 1e-3);
  const double by_speed = (drop_with(6.0, 10.01) - drop_with(6.0, 9.99)) / 0.02;
  CHECK(std::fabs(price_of(lowest, LimitId::exit_speed) / by_speed - 1.0) < 1e-3);
}

}  // namespace free_ends_test
