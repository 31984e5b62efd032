// Waypoints are passed in the order in which they are given.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/referee/referee.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace waypoints_test {

using namespace glissade;

namespace {

Problem slide() {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  return problem;
}

double worst_miss(const std::vector<LimitCheck>& checks) {
  double worst = 0.0;
  for (const LimitCheck& check : checks) {
    if (check.limit.id == LimitId::waypoints) worst = std::max(worst, check.violation);
  }
  return worst;
}

}  // namespace

TEST_CASE("waypoints that only a track running back could pass in their order are refused, with both named") {
  Problem problem = slide();
  problem.limits.waypoints = {{6.0, 4.0}, {3.0, 3.0}};
  try {
    (void)optimize(problem);
    FAIL("accepted");
  } catch (const InputError& error) {
    const std::string text = error.what();
    CAPTURE(text);
    CHECK(text.find("waypoints[1]: 3 m along the run lies before waypoints[0], 6 m") != std::string::npos);
    CHECK(text.find("the waypoints in the order of their runs") != std::string::npos);
  }
  std::reverse(problem.limits.waypoints.begin(), problem.limits.waypoints.end());
  const Optimum optimum = optimize(problem);
  INFO(optimum.report.brief());
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  CHECK(worst_miss(optimum.report.checks) < 1e-5);
}

TEST_CASE("a given track that runs back is held to the order of its waypoints") {
  Problem problem = slide();
  // Half a turn: out, then back below.
  const double radius = 2.0;
  const auto track = std::make_shared<ClothoidSpline>(
      Angle::from_radians(0.0),
      std::vector<ClothoidSegment>{{4.0, 0.0, 0.0}, {3.0 * radius, -1.0 / radius, -1.0 / radius}});
  const Vec2 out{track->at(3.0).x, track->at(3.0).drop};
  const Vec2 back{track->at(9.5).x, track->at(9.5).drop};
  const CenterlinePoint end = track->at(track->length());
  problem.endpoints = {end.x, end.drop};
  problem.body.entry_speed = 8.0;
  problem.limits.lowest_normal_load = 0.0;
  problem.limits.waypoints = {out, back};
  CHECK(worst_miss(check_limits(problem, track)) < 1e-9);
  problem.limits.waypoints = {back, out};
  CHECK(worst_miss(check_limits(problem, track)) > 0.5);
}

TEST_CASE("several waypoints that no search finds a way through are no conflict: more of them may show one") {
  Problem problem;
  problem.endpoints = {10.0, 6.0};
  problem.body.friction = Friction::from_coefficient(0.15);
  problem.limits.waypoints = {{3.8611525204706716, 3.9861320463697174},
                              {4.234352649335118, 3.697612749557139},
                              {4.350617907415895, 4.173226664742665},
                              {5.392527567609447, 4.52390970570931}};
  const Optimum optimum = optimize(problem);
  INFO(optimum.report.message);
  CHECK(optimum.report.status != OptimizeStatus::infeasible);
  if (!optimum.centerline)
    CHECK(optimum.report.message.find("no conflict between them is certain") != std::string::npos);
}

}  // namespace waypoints_test
