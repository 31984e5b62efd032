// Places before an edge that is given, the start being what is free.

#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/places.hpp"
#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/thorough.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace places_to_edge_test {

using namespace glissade;
using testing_problems::drop_of;
using testing_problems::solved;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// The lowest in-run for 27 m/s; places count from its edge.
Problem lowest_in_run() {
  Problem problem;
  problem.gravity = 9.81;
  problem.body.friction = Friction::from_coefficient(0.03);
  problem.body.drag_per_metre = 0.0013;
  problem.finish.kind = FinishKind::anywhere;
  problem.places_from = PlacesFrom::finish;
  problem.objective.kind = ObjectiveKind::least_drop;
  Limits& limits = problem.limits;
  limits.exit_speed.lowest = 27.0;
  limits.slope_angle.highest = 35.0 * kDegree;
  limits.exit_slope_angle = Range::fixed(11.0 * kDegree);
  limits.highest_curvature_rate = 6e-4;
  limits.lead_out = 6.9;
  return problem;
}

/// Its answer: in several tests, solved once.
const Optimum& lowest_of_all() {
  static const Optimum found = solved(lowest_in_run());
  return found;
}

/// A place above a track, counted from its edge.
Vec2 raised(const Optimum& optimum, double run, double height) {
  const Centerline& track = *optimum.centerline;
  const CenterlinePoint point = track.at(track.arc_length_at_run(track.endpoints().run + run));
  return {run, point.drop - track.endpoints().drop - height};
}

/// A bridge 10 m wide whose lower edge hangs below a track, so that the track has to pass under it.
KeepOut bridge(const Optimum& open, double clearance) {
  const Vec2 corner = raised(open, -50.0, -0.3);
  return {{corner, corner + Vec2{10.0, 0.0}, corner + Vec2{10.0, -3.0}, corner - Vec2{0.0, 3.0}},
          clearance,
          Passage::below};
}

/// The same with both ends given, the start where it came to lie, and places counted from there.
Problem from_its_start(const Problem& problem, const Optimum& found) {
  const Endpoints ends = found.centerline->endpoints();
  Problem other = testing::counted_from_finish(problem, {-ends.run, -ends.drop});
  other.places_from = PlacesFrom::start;
  other.endpoints = ends;
  other.finish = {};
  return other;
}

}  // namespace

TEST_CASE("an in-run past what is in its way costs tower, and is no lower than what its own start allows") {
  Problem problem = lowest_in_run();
  const Optimum& open = lowest_of_all();
  if (testing::thorough()) {  // some seconds; elsewhere the bridge is that of the clearance below
    SECTION("a bridge") {
      problem.limits.keep_outs.push_back(bridge(open, 0.2));
    }
  }
  SECTION("a ceiling, and what a rider needs under it") {
    problem.limits.stay_below.push_back(
        {{raised(open, -70.0, 2.5), raised(open, -60.0, 1.9), raised(open, -30.0, 2.2)}, 0.1});
    problem.limits.envelope = {0.4, 0.1, 2.0};
  }
  SECTION("a point to pass through") {
    problem.limits.waypoints.push_back(raised(open, -50.0, -0.5));
  }
  const Optimum optimum = solved(problem);
  CHECK(drop_of(optimum) > drop_of(open) + 1e-4);
  // Were another track from there faster at the edge, a lower start would have done.
  Problem fixed = from_its_start(problem, optimum);
  fixed.limits.exit_speed = {};
  fixed.objective.kind = ObjectiveKind::exit_speed;
  CHECK(std::fabs(solved(fixed).report.exit_speed / optimum.report.exit_speed - 1.0) < 1e-6);
}

TEST_CASE(
    "what is far from an in-run changes nothing, and what lies at its edge is told before anything is "
    "searched") {
  Problem problem = lowest_in_run();
  const double open = drop_of(lowest_of_all());
  problem.limits.keep_outs.push_back({{{-30.0, 10.0}, {-20.0, 10.0}, {-20.0, 15.0}}, 0.5, Passage::either});
  problem.limits.stay_above.push_back({{{-90.0, -45.0}, {-40.0, -8.0}, {0.0, 3.0}}, 0.1});
  problem.limits.half_planes.push_back({{-120.0, 0.0}, {-1.0, 0.0}, 1.0});
  const Optimum beside = solved(problem);
  CHECK(std::fabs(drop_of(beside) / open - 1.0) < 1e-7);
  for (const ActiveLimit& active : beside.report.active) CHECK(active.limit.key() != "keep_outs[0]");
  problem.limits.keep_outs.front().outline = {{-2.0, 0.3}, {2.0, 0.3}, {2.0, 5.0}, {-2.0, 5.0}};
  problem.limits.envelope = {0.6, 0.0, 0.0};
  const Optimum none = optimize(problem);
  CHECK(none.centerline == nullptr);
  CHECK(none.report.status == OptimizeStatus::infeasible);
  CHECK(none.report.message.find("the finish lies too close to keep_outs[0]") != std::string::npos);
}

TEST_CASE("a clearance before the edge that is relaxed never asks for a higher start") {
  Problem problem = lowest_in_run();
  problem.limits.keep_outs.push_back(bridge(lowest_of_all(), 0.6));
  double before = HUGE_VAL;
  for (const double clearance : {0.6, 0.4, 0.0}) {
    problem.limits.keep_outs.front().clearance = clearance;
    const double drop = drop_of(solved(problem));
    CHECK(drop < before * (1.0 + 1e-7));
    before = drop;
  }
}

TEST_CASE("the least load under a bridge, kept as a limit, needs just the height that it was found from") {
  if (!testing::thorough()) return;  // without the bridge free_ends_test.cpp holds it
  Problem gentle = lowest_in_run();
  gentle.limits.keep_outs.push_back(bridge(lowest_of_all(), 0.2));
  Problem lowest = gentle;
  const double height = drop_of(solved(lowest)) + 0.3;
  gentle.objective.kind = ObjectiveKind::least_load;
  gentle.finish.kind = FinishKind::level;
  gentle.endpoints = {0.0, height};
  const Optimum least = solved(gentle);
  lowest.limits.highest_normal_load = Motion(least.centerline, gentle.body, 9.81).highest_load().normal_load;
  CHECK(std::fabs(drop_of(solved(lowest)) / height - 1.0) < 1e-5);
}

}  // namespace places_to_edge_test
