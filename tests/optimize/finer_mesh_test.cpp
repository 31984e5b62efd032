// The same problem on three times as many pieces: what the usual number of them loses, and what a report tells of that.

#include "glissade/core/units.hpp"

#include "optimize/random_limits.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace finer_mesh_test {

using namespace glissade;

namespace {

constexpr int kManyPieces = 96;

struct Drawn {
  std::uint64_t seed = 20250217;
  int index = 0;
};

Problem problem_of(const Drawn& drawn) {
  testing::Random random(drawn.seed);
  Problem problem;
  for (int i = 0; i <= drawn.index; ++i) problem = testing_problems::random_limited(random);
  return problem;
}

double objective_of(const Problem& problem, const OptimizeReport& report) {
  const Objective& objective = problem.objective;
  if (objective.kind == ObjectiveKind::exit_speed) return -report.exit_speed;
  if (objective.kind != ObjectiveKind::blend) return report.travel_time;
  return report.travel_time - objective.exit_speed_weight * report.exit_speed;
}

/// What the usual pieces lose against many, as a share of the objective, and what the report tells of it.
struct Loss {
  double lost = 0.0;
  double told = 0.0;
};

Loss loss_of(const Problem& problem) {
  const Optimum usual = optimize(problem);
  OptimizeOptions options;
  options.pieces = kManyPieces;
  const Optimum many = optimize(problem, options);
  CAPTURE(usual.report.brief(), many.report.brief());
  REQUIRE(usual.report.status == OptimizeStatus::optimal);
  REQUIRE(many.report.status == OptimizeStatus::optimal);
  REQUIRE(usual.report.finer_mesh_wins);
  const double least = objective_of(problem, many.report);
  return {(objective_of(problem, usual.report) - least) / std::fabs(least), *usual.report.finer_mesh_wins};
}

}  // namespace

TEST_CASE("beside a straight end the usual pieces lose no more than a time's accuracy, corner or none") {
  constexpr double kLost = 1e-6;
  // A corner where no radius is asked for, a crest at a load of its own, ...
  for (const int index : {58, 64}) {
    CAPTURE(index);
    CHECK(loss_of(problem_of({20250217, index})).lost < kLost);
  }
  // ... and an arc of the smallest radius.
  Problem arc;
  arc.endpoints = {1.0, 1.0};
  arc.body.friction = Friction::from_coefficient(0.2);
  arc.limits.entry_slope_angle = Range::fixed(1.57);
  arc.limits.smallest_valley_radius = 0.1;
  for (const double end : {0.1, 0.2}) {
    CAPTURE(end);
    arc.limits.lead_in = end;
    arc.limits.lead_out = 0.5 * end;
    CHECK(loss_of(arc).lost < kLost);
  }
}

TEST_CASE("where pieces halved for prices win more than a time's accuracy, their track is the answer") {
  constexpr double kLost = 1e-6;
  std::vector<Drawn> all{{20250217, 19}, {1, 83}};
  if (testing::thorough()) all.insert(all.end(), {{20250217, 93}, {1, 21}, {1, 125}, {2, 37}, {2, 83}});
  for (const Drawn& drawn : all) {
    CAPTURE(drawn.seed, drawn.index);
    CHECK(loss_of(problem_of(drawn)).lost < kLost);
  }
}

TEST_CASE("a bound moved by little moves the time by its price, wherever among the pieces curvature jumps") {
  // Flung over a crest at no load onto the steepest slope allowed: curvature jumps in the first hundredth of the track.
  struct Between {
    Endpoints endpoints;
    double friction, lowest, highest;  // slopes [deg]
    double highest_load;               // [g], none: 0
  };
  constexpr double kLost = 1e-6;
  constexpr double kStep = 0.005;  // [deg]
  for (const Between& drawn : {Between{{8.0, 5.6598}, 0.2287, 19.8908496, 40.8390621, 0.0},
                               Between{{20.0, 18.9672}, 0.1533, 24.0174946, 59.9986317, 1.56874535}}) {
    Problem problem;
    problem.endpoints = drawn.endpoints;
    problem.body.friction = Friction::from_coefficient(drawn.friction);
    problem.body.entry_speed = 2.0;
    problem.limits.slope_angle.highest = Angle::from_degrees(drawn.highest).radians();
    if (drawn.highest_load > 0.0) problem.limits.highest_normal_load = drawn.highest_load * kStandardGravity;
    std::optional<OptimizeReport> before;
    const int most = testing::thorough() ? 3 : 1;
    for (int i = -most; i <= most; ++i) {
      problem.limits.slope_angle.lowest = Angle::from_degrees(drawn.lowest + kStep * i).radians();
      const OptimizeReport report = optimize(problem).report;
      CAPTURE(drawn.lowest, i, report.brief());
      REQUIRE(report.status == OptimizeStatus::optimal);
      if (before) {
        const auto price_of = [](const OptimizeReport& told) {
          const auto active = std::find_if(
              told.active.begin(), told.active.end(),
              [](const ActiveLimit& limit) { return limit.limit.key() == "slope_angle.lowest"; });
          return active == told.active.end() ? 0.0 : active->price;
        };
        const double price = 0.5 * (price_of(report) + price_of(*before));
        CHECK(price > 0.0);
        const double off =
            report.travel_time - before->travel_time - price * Angle::from_degrees(kStep).radians();
        CHECK(std::fabs(off) < kLost * report.travel_time);
      }
      before = report;
    }
    CHECK(loss_of(problem).lost < kLost);
  }
}

TEST_CASE(
    "from rest a slope that is held costs nothing: the body turns down at once, as tightly as it takes") {
  // Where nothing else holds it, the fastest track without limits is what such tracks tend to.
  constexpr double kLost = 1e-6;
  testing::Random random(11);
  const int count = testing::thorough() ? 24 : 8;
  for (int i = 0; i < count; ++i) {
    const double mu = random.between(0.0, 0.5);
    const double ratio = std::max(1.3 * mu, random.between(0.4, 2.0));
    const double run = (i % 2 == 0 ? 1.0 : -1.0) * random.between(1.0, 30.0);
    Problem problem;
    problem.endpoints = {run, ratio * std::fabs(run)};
    problem.body.friction = Friction::from_coefficient(mu);
    problem.limits.entry_slope_angle = Range::fixed(std::atan(ratio) + random.between(0.0, 0.4));
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(i, mu, ratio, run, report.brief());
    REQUIRE(report.status == OptimizeStatus::optimal);
    const double lost = report.travel_time / report.unlimited_travel_time.value() - 1.0;
    CAPTURE(lost);
    CHECK(lost < kLost);
    CHECK(lost < 1.5 * report.finer_mesh_wins.value_or(0.0));
  }
}

TEST_CASE("where such a start has more limits three times as many pieces win little, and it is told") {
  std::vector<Drawn> all{{1, 5}, {3, 31}};
  if (testing::thorough()) all.insert(all.end(), {{2, 74}, {20250217, 32}});
  for (const Drawn& drawn : all) {
    CAPTURE(drawn.seed, drawn.index);
    const Loss loss = loss_of(problem_of(drawn));
    CAPTURE(loss.lost, loss.told);
    CHECK(loss.lost <= 1e-6);
  }
}

TEST_CASE("what a finer mesh would win is told to be no less than many pieces win") {
  constexpr double kNothing = 1e-6;
  std::vector<Drawn> all{{20250217, 97}, {20250217, 118}};
  if (testing::thorough()) all.insert(all.end(), {{20250217, 144}, {2, 1}});
  for (const Drawn& drawn : all) {
    CAPTURE(drawn.seed, drawn.index);
    const Loss loss = loss_of(problem_of(drawn));
    CHECK(loss.lost <= std::max(loss.told, kNothing));
  }
}

TEST_CASE("nothing is told to be left where nothing is left to win") {
  // Rows far from their bounds, broken by the step of a program without them, made it promise 1e-5 of the time.
  Problem in_run;
  in_run.endpoints = {85.0, 48.0};
  in_run.body.friction = Friction::from_coefficient(0.05);
  in_run.body.drag_per_metre = 0.0017;
  in_run.limits.slope_angle = {0.0, Angle::from_degrees(37.0).radians()};
  in_run.limits.exit_slope_angle = Range::fixed(Angle::from_degrees(11.0).radians());
  in_run.limits.lead_out = 6.5;
  in_run.limits.highest_curvature_rate = 0.002;
  double before = HUGE_VAL;
  for (const double load : {1.775, 1.8, 1.85, 1.9, 1.975}) {
    if ((load == 1.8 || load == 1.9) && !testing::thorough()) continue;
    in_run.limits.highest_normal_load = load * kStandardGravity;
    const OptimizeReport report = optimize(in_run).report;
    CAPTURE(load, report.brief());
    REQUIRE(report.status == OptimizeStatus::optimal);
    CHECK(report.finer_mesh_wins.value() < 2e-7);
    CHECK(report.travel_time < before * (1.0 + 1e-7));
    before = report.travel_time;
  }
  // A sharper crest that broke its limits was told to win an eighth.
  for (const int index : {257, 293}) {
    const OptimizeReport report = optimize(problem_of({1, index})).report;
    CAPTURE(index, report.brief());
    REQUIRE(report.status == OptimizeStatus::optimal);
    CHECK(report.finer_mesh_wins.value() < 1e-5);
  }
}

}  // namespace finer_mesh_test
