// Each kind of limit: what the optimum is where it can be derived by hand, what the referee says of the rest.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stop_token>
#include <string>
#include <vector>

namespace limits_test {

using namespace glissade;
using Catch::Matchers::Contains;
using testing_problems::solved;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Problem slide(double run, double drop, double mu) {
  Problem problem;
  problem.endpoints = {run, drop};
  problem.body.friction = Friction::from_coefficient(mu);
  return problem;
}

}  // namespace

TEST_CASE("slope limits that leave one shape give the straight ramp") {
  Problem problem = slide(10.0, 5.0, 0.2);
  const double mean = std::atan2(5.0, 10.0);
  problem.limits.slope_angle.highest = mean + 1e-4;
  const double length = std::hypot(10.0, 5.0);
  const double ramp = std::sqrt(2.0 * length / (9.81 * (std::sin(mean) - 0.2 * std::cos(mean))));
  CHECK(solved(problem).report.travel_time == Approx(ramp).epsilon(1e-3));
}

TEST_CASE(
    "straight ends that leave hardly anything between them are kept, and no slower than the straight line") {
  const double chord = std::hypot(3.0, 2.0);
  const double slope = std::atan2(2.0, 3.0);
  const double straight = std::sqrt(2.0 * chord / (9.81 * (std::sin(slope) - 0.2 * std::cos(slope))));
  for (const bool at_start : {false, true}) {
    double before = 0.0;
    int number = 0;
    for (const double share : {0.90, 0.94, 0.96, 0.97, 0.98, 0.99, 0.999}) {
      // Every other one, elsewhere than in CI.
      if (number++ % 2 == 1 && !testing::thorough()) continue;
      Problem problem = slide(3.0, 2.0, 0.2);
      problem.limits.smallest_valley_radius = 30.0;
      problem.limits.smallest_crest_radius = 30.0;
      (at_start ? problem.limits.lead_in : problem.limits.lead_out) = share * chord;
      const OptimizeReport report = solved(problem).report;
      CAPTURE(at_start, share, report.brief());
      CHECK(report.travel_time <= straight * (1.0 + 1e-6));
      // The longer a straight end, the slower.
      CHECK(report.travel_time >= before * (1.0 - 1e-6));
      before = report.travel_time;
    }
  }
}

TEST_CASE("where contact alone holds a track back it is no slower than the fastest of all that keeps it") {
  // Next to the reach limit, where that one is all but straight for most of its way.
  struct Near {
    double run, drop, friction, speed;
  };
  for (const Near& drawn :
       {Near{10.0, 4.8175, 0.48172, 0.06625}, Near{10.0, 6.0, 0.2, 5.0}, Near{10.0, 3.01, 0.3, 0.5}}) {
    Problem problem = slide(drawn.run, drawn.drop, drawn.friction);
    problem.body.entry_speed = drawn.speed;
    const OptimizeReport report = solved(problem).report;
    CAPTURE(drawn.drop, drawn.friction, drawn.speed, report.brief());
    REQUIRE(report.unlimited_travel_time);
    CHECK(report.travel_time == Approx(*report.unlimited_travel_time).epsilon(1e-6));
  }
}

TEST_CASE("a rate of curvature next to none is kept: arcs of one radius are") {
  Problem problem = slide(3.0, 2.0, 0.2);
  problem.limits.highest_curvature_rate = 1e-6;
  const double arc = solved(problem).report.travel_time;
  for (const double rate : {1e-9, 1e-10, 1e-12, 1e-20}) {
    problem.limits.highest_curvature_rate = rate;
    const Optimum optimum = optimize(problem);
    CAPTURE(rate, optimum.report.brief());
    REQUIRE(optimum.centerline);
    CHECK(optimum.report.travel_time == Approx(arc).epsilon(1e-5));
  }
}

// A track grows and shrinks while it is searched: the place stays where it is.
TEST_CASE("a lowest speed from a place on holds there, and the faster it is, the more it costs") {
  struct Before {
    double lowest = 0.0;
    double exit_speed = HUGE_VAL;
    double price = 0.0;
  };
  for (const bool range : {false, true}) {
    Before before;
    for (const double lowest : {2.9, 3.0, 3.1, 3.15, 3.2}) {
      if (lowest > 3.1 && !testing::thorough()) continue;
      Problem problem = slide(8.0, 5.0, range ? 0.306 : 0.404);
      if (range) {
        problem.low_friction = Friction::from_coefficient(0.176);
        problem.high_friction = Friction::from_coefficient(0.404);
      }
      problem.body.entry_speed = 2.0;
      problem.objective.kind = ObjectiveKind::exit_speed;
      problem.limits.smallest_valley_radius = 2.0;
      problem.limits.smallest_crest_radius = 2.0;
      problem.limits.exit_slope_angle.highest = 10.0 * kDegree;
      problem.limits.speed.lowest = lowest;
      problem.limits.lowest_speed_from = 1.0;
      const OptimizeReport report = solved(problem).report;
      CAPTURE(range, lowest, report.brief());
      CHECK(report.status == OptimizeStatus::optimal);
      const auto is_speed = [](const auto& of) { return of.limit.key() == "speed.lowest"; };
      const auto check = std::find_if(report.checks.begin(), report.checks.end(), is_speed);
      const auto active = std::find_if(report.active.begin(), report.active.end(), is_speed);
      REQUIRE(check != report.checks.end());
      REQUIRE(active != report.active.end());
      // It binds at the place alone.
      CHECK(check->reached == Approx(lowest).epsilon(1e-5));
      if (before.price > 0.0) {
        const double lost = before.exit_speed - report.exit_speed;
        CHECK(lost > 0.0);
        CHECK(active->price > before.price);
        // By the trapezoidal rule, whose third derivative is next to nothing here.
        const double step = lowest - before.lowest;
        CHECK(lost == Approx(0.5 * step * (before.price + active->price)).epsilon(0.02));
      }
      before = {lowest, report.exit_speed, active->price};
    }
  }
}

// Where a straight ends in a kink, each mesh has it anew; and where a body all but stands still at the end, speed is told by
// energies that are next to nothing.
TEST_CASE("a kink behind a straight and a body that just arrives need no long search") {
  for (const double lead_in : {0.8, 1.0}) {
    Problem problem;
    problem.endpoints = {8.6, 1.7};
    problem.body.friction = Friction::from_coefficient(0.16);
    problem.low_friction = Friction::from_coefficient(0.136);
    problem.high_friction = Friction::from_coefficient(0.176);
    problem.limits.lead_in = lead_in;
    const OptimizeReport report = optimize(problem).report;
    CAPTURE(lead_in, report.brief());
    CHECK(report.status == OptimizeStatus::optimal);
    CHECK(report.first_order_residual < 1e-8);
    // It was some thousands, the longer straight without an end.
    CHECK(report.evaluations < 500);
  }
}

TEST_CASE("referee: where a body comes to a stand no lowest speed is kept, behind it neither", "[limits]") {
  const auto level = std::make_shared<const ClothoidSpline>(Angle::from_degrees(0.0),
                                                            std::vector<ClothoidSegment>{{2.0, 0.0, 0.0}});
  for (const double from : {0.0, 0.5, 1.0}) {
    CAPTURE(from);
    Problem problem;
    problem.endpoints = {2.0, 0.0};
    problem.body.friction = Friction::from_coefficient(0.3);
    problem.body.entry_speed = 2.0;
    problem.limits.speed.lowest = 0.05;
    problem.limits.lowest_speed_from = from;
    problem.limits.exit_speed.lowest = 1.0;
    const std::vector<LimitCheck> checks = check_limits(problem, level);
    const auto of = [&](LimitId id) -> const LimitCheck& {
      const LimitName name{id, Bound::lowest};
      return *std::find_if(checks.begin(), checks.end(),
                           [&](const LimitCheck& check) { return check.limit == name; });
    };
    // v^2/(2 mu g)
    const double stand = 4.0 / (2.0 * 0.3 * problem.gravity);
    const LimitCheck& speed = of(LimitId::speed);
    CHECK(speed.reached == 0.0);
    CHECK(speed.violation == Approx(0.05));
    CHECK(speed.where == Approx(stand));
    const LimitCheck& exit = of(LimitId::exit_speed);
    CHECK(exit.reached == 0.0);
    CHECK(exit.violation == Approx(1.0));
  }
}

TEST_CASE("a limit that does not bind changes nothing and costs nothing") {
  Problem problem = slide(10.0, 5.0, 0.2);
  const double free_time = solved(problem).report.travel_time;
  problem.limits.arc_length.highest = 30.0;
  problem.limits.speed.highest = 40.0;
  const Optimum optimum = solved(problem);
  CHECK(optimum.report.travel_time == Approx(free_time).epsilon(1e-6));
  CHECK(optimum.report.active.empty());
}

TEST_CASE("a search tells what a finer mesh would win beside the residual of its own") {
  Problem problem = slide(10.0, 5.0, 0.2);
  CHECK(!solved(problem).report.finer_mesh_wins);
  problem.limits.slope_angle.highest = 40.0 * kDegree;
  problem.limits.smallest_valley_radius = 6.0;
  const OptimizeReport report = solved(problem).report;
  REQUIRE(report.finer_mesh_wins);
  CHECK(*report.finer_mesh_wins >= 0.0);
  CHECK(*report.finer_mesh_wins <= 1e-6);
  CHECK(report.brief().find(", a finer mesh would win ") != std::string::npos);
  // As a search on a mesh of many more pieces has it.
  OptimizeOptions finer;
  finer.pieces = 96;
  const double time = optimize(problem, finer).report.travel_time;
  CHECK(report.travel_time / time - 1.0 <= 10.0 * *report.finer_mesh_wins + 1e-7);
}

TEST_CASE("a slope of 20 deg cannot lead down a mean slope of 26.6 deg, and the report says what would") {
  Problem problem = slide(10.0, 5.0, 0.2);
  problem.limits.slope_angle.highest = 20.0 * kDegree;
  const Optimum optimum = optimize(problem);
  REQUIRE(optimum.report.status == OptimizeStatus::infeasible);
  CHECK(!optimum.centerline);
  REQUIRE(optimum.report.conflict.relaxations.size() == 1);
  CHECK(optimum.report.conflict.relaxations[0].limit.key() == "slope_angle.highest");
  // 26.5651 deg, as four digits tell it.
  CHECK(optimum.report.conflict.relaxations[0].needed == Approx(26.57 * kDegree).epsilon(1e-12));
  CHECK(optimum.report.message ==
        "slope_angle.highest 20 deg cannot be met; it would take slope_angle.highest 26.57 deg");
}

TEST_CASE("from rest, a mean slope below the friction angle is out of reach") {
  const Optimum optimum = optimize(slide(10.0, 5.0, 0.51));
  CHECK(optimum.report.status == OptimizeStatus::infeasible);
  CHECK(optimum.report.message.find("reach theorem") != std::string::npos);
}

TEST_CASE("next to the reach limit a search says that it cannot tell tracks apart, and at once") {
  Problem problem;
  problem.body.friction = Friction::from_coefficient(0.2);
  problem.body.drag_per_metre = 0.01;
  const auto beyond = [&](double share) {
    problem.endpoints = {10.0, 2.0 * (1.0 + share)};
    return optimize(problem);
  };
  for (const double share : {1e-6, 1e-7}) {
    CAPTURE(share);
    const Optimum near = beyond(share);
    CHECK(near.report.status == OptimizeStatus::feasible_not_converged);
    CHECK_THAT(near.report.message,
               Contains("a search takes for lying still") && Contains("try a drop of 2.001"));
    CHECK(near.report.evaluations == 0);
    CHECK_FALSE(near.report.finer_mesh_wins);
    CHECK(near.report.convergence_text() == "how near an optimum it is did not come out");
    REQUIRE(near.centerline);
    CHECK(Motion(near.centerline, problem.body, problem.gravity).arrived());
  }
  // A little further a search is made, which stays behind the straight line.
  const Optimum between = beyond(3.2e-6);
  CHECK(between.report.status == OptimizeStatus::feasible_not_converged);
  CHECK_THAT(between.report.message, Contains("a search takes for lying still"));
  // Where it is that which holds the exit speed up, as no limit does, another track may be the faster one: here by 8e-3.
  Problem held;
  held.body.friction = problem.body.friction;
  held.endpoints = {10.0, 2.0002};
  held.limits.smallest_valley_radius = held.limits.smallest_crest_radius = 1.0;
  const Optimum slow = optimize(held);
  CHECK(slow.report.status == OptimizeStatus::feasible_not_converged);
  CHECK_THAT(slow.report.message, Contains("no faster than what a search takes for lying still"));
  // A drop as large as it tells to try leaves an optimum to be found, much faster than the straight line.
  const Optimum told = beyond(5.1e-4);
  CHECK(told.report.status == OptimizeStatus::optimal);
  const Motion straight(std::make_shared<StraightLine>(problem.endpoints), problem.body, problem.gravity);
  CHECK(told.report.travel_time < 0.8 * straight.travel_time());
  // Without drag, and limits that bind, the exact optimum is known as near as one likes.
  problem.body.drag_per_metre = 0.0;
  problem.limits.arc_length.highest = 15.0;
  const Optimum exact = beyond(1e-7);
  CHECK(exact.report.status == OptimizeStatus::optimal);
  CHECK(exact.report.travel_time == Approx(*exact.report.unlimited_travel_time));
}

TEST_CASE("a time budget that is none is told with what it has to be") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  for (const double budget : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    OptimizeOptions options;
    options.time_budget = budget;
    CHECK_THROWS_WITH(optimize(problem, options), Catch::Matchers::Contains("time_budget: ") &&
                                                      Catch::Matchers::Contains("is positive and finite"));
  }
}

TEST_CASE(
    "a budget that runs out before the search comes to a track ends with a simple one, where one will do") {
  OptimizeOptions hurried;
  hurried.time_budget = 1e-6;
  std::vector<Problem> problems(4);
  for (Problem& problem : problems) {
    problem.endpoints = {10.0, 5.0};
    problem.body.friction = Friction::from_coefficient(0.1);
  }
  // A straight line, a bend between two given slopes, one whose curvature grows and fades, and the steepest ramp.
  problems[0].limits.highest_curvature_rate = 0.05;
  problems[1].limits.entry_slope_angle = Range::fixed(0.8);
  problems[1].limits.exit_slope_angle = Range::fixed(0.1);
  problems[1].limits.smallest_valley_radius = 3.0;
  problems[2].limits.entry_slope_angle = Range::fixed(0.6);
  problems[2].limits.exit_slope_angle = Range::fixed(0.3);
  problems[2].limits.highest_curvature_rate = 0.5;
  problems[2].limits.lead_out = 1.0;
  problems[3].finish.kind = FinishKind::anywhere;
  problems[3].objective.kind = ObjectiveKind::least_drop;
  problems[3].limits.exit_speed.lowest = 8.0;
  problems[3].limits.slope_angle.highest = 1.0;
  problems[3].limits.exit_slope_angle = Range::fixed(0.2);
  for (const Problem& problem : problems) {
    const Optimum early = optimize(problem, hurried);
    CAPTURE(&problem - problems.data(), early.report.brief());
    CHECK(early.report.status == OptimizeStatus::feasible_not_converged);
    CHECK(early.report.ended_early);
    REQUIRE(early.centerline);
    for (const LimitCheck& check : check_limits(problem, early.centerline)) {
      CAPTURE(check.limit.key(), check.reached);
      CHECK(check.kept());
    }
  }
  // Whoever asks to stop wants no other track than the search's.
  std::stop_source source;
  source.request_stop();
  for (const Problem& problem : problems) {
    const Optimum stopped = optimize(problem, {}, source.get_token());
    if (stopped.centerline) CHECK(stopped.report.message == "stopped: the best track so far");
  }
}

}  // namespace limits_test
