// Tracks that run round a corner of an obstacle, farther from it than their tightest bend.

#include "glissade/optimize/optimize.hpp"

#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <cmath>
#include <vector>

namespace round_corners_test {

using namespace glissade;
using testing_problems::solved;

namespace {

constexpr double kGravity = 9.81;
constexpr Vec2 kFinish{10.0, 3.0};

/// A wedge that hangs down to a point.
KeepOut wedge(Vec2 tip, double clearance) {
  return {{tip, tip + Vec2{0.3, -4.0}, tip + Vec2{-0.3, -4.0}}, clearance, Passage::below};
}

/// Nearly the same speed everywhere: the fastest track is the shortest.
Problem at_speed(double speed) {
  Problem problem;
  problem.gravity = kGravity;
  problem.endpoints = {kFinish.x, kFinish.y};
  problem.body.friction = Friction::from_coefficient(0.0);
  problem.body.entry_speed = speed;
  return problem;
}

/// Travel time along two tangents of a circle below its centre, and the arc between them.
double time_round(Vec2 centre, double radius, double speed) {
  const auto point_on = [&](double angle) {
    return centre + radius * Vec2{std::cos(angle), std::sin(angle)};
  };
  const double to_start = std::atan2(-centre.y, -centre.x);
  const double to_finish = std::atan2(kFinish.y - centre.y, kFinish.x - centre.x);
  const double first = to_start - std::acos(radius / norm(centre));
  const double last = to_finish + std::acos(radius / norm(kFinish - centre));
  const double turned = std::remainder(first - last, 2.0 * std::acos(-1.0));
  double time = 0.0;
  const auto ride = [&](auto&& at, double length) {
    constexpr int kSteps = 4000;
    for (int i = 0; i < kSteps; ++i) {
      const double drop = at((i + 0.5) / kSteps).y;
      time += length / kSteps / std::sqrt(speed * speed + 2.0 * kGravity * drop);
    }
  };
  const Vec2 on = point_on(first);
  const Vec2 off = point_on(last);
  ride([&](double share) { return share * on; }, norm(on));
  ride([&](double share) { return point_on(first - share * turned); }, radius * turned);
  ride([&](double share) { return off + share * (kFinish - off); }, norm(kFinish - off));
  return time;
}

}  // namespace

TEST_CASE("round a corner: the shortest track is two tangents and an arc, however short") {
  constexpr double kSpeed = 1000.0;
  for (const double radius : {0.3, 0.9, 1.5}) {
    for (const double below : {-0.9, -0.5, -0.1, 0.4}) {
      // Below the straight line, less the radius: how far the track is pushed down.
      const Vec2 tip{4.0, 1.2 + below * radius};
      CAPTURE(radius, below);
      const double expected = time_round(tip, radius, kSpeed);
      Problem plain = at_speed(kSpeed);
      plain.limits.keep_outs.push_back(wedge(tip, radius));
      CHECK(std::fabs(solved(plain).report.travel_time / expected - 1.0) < 1e-6);
      Problem walls = at_speed(kSpeed);
      walls.limits.envelope = {0.0, 0.8 * radius, 0.0};
      walls.limits.keep_outs.push_back(wedge(tip, 0.2 * radius));
      CHECK(std::fabs(solved(walls).report.travel_time / expected - 1.0) < 1e-6);
    }
  }
}

TEST_CASE("round a corner: a channel with headroom below a beam") {
  Problem problem;
  problem.gravity = kGravity;
  problem.endpoints = {8.0, 6.0};
  problem.body.friction = Friction::from_coefficient(0.3);
  problem.limits.keep_outs.push_back(
      {{{1.2, 1.0}, {1.6, 1.0}, {1.6, 0.5}, {1.2, 0.5}}, 0.1, Passage::either});
  double before = 0.0;
  for (const double headroom : {0.6, 0.7, 0.8, 0.9, 1.0}) {
    CAPTURE(headroom);
    problem.limits.envelope = {0.004, 0.6, headroom};
    const Optimum found = solved(problem);
    CHECK(found.report.travel_time >= before * (1.0 - 1e-6));
    CHECK(found.report.finer_mesh_wins.value_or(0.0) < 1e-6);
    before = found.report.travel_time;
  }
}

TEST_CASE("round a corner: drawn beams, more of them with more room are never slower to pass") {
  testing::Random random = testing::seeded_random(20261122);
  INFO("GLISSADE_SEED=" << random.seed());
  int passed = 0;
  for (int i = 0; i < 12; ++i) {
    Problem problem;
    problem.gravity = kGravity;
    problem.endpoints = {random.between(5.0, 12.0), random.between(3.0, 7.0)};
    problem.body.friction = Friction::from_coefficient(random.between(0.05, 0.3));
    const double x = random.between(0.3, 0.7) * problem.endpoints.run;
    const double y = problem.endpoints.drop * x / problem.endpoints.run + random.between(0.1, 0.8);
    const double clearance = random.between(0.4, 0.8);
    double before = 0.0;
    CAPTURE(i, problem.endpoints.run, problem.endpoints.drop, x, y, clearance);
    for (const double share : {0.4, 0.7, 1.0}) {
      problem.limits.keep_outs = {
          {{{x, y}, {x + 0.4, y}, {x + 0.4, y - 0.6}, {x, y - 0.6}}, share * clearance, Passage::below}};
      const Optimum found = optimize(problem);
      if (found.report.status == OptimizeStatus::infeasible) break;
      CAPTURE(share);
      INFO(found.report.brief());
      REQUIRE(found.report.status == OptimizeStatus::optimal);
      CHECK(found.report.travel_time >= before * (1.0 - 1e-5));
      before = found.report.travel_time;
      ++passed;
    }
  }
  CHECK(passed >= 24);
}

}  // namespace round_corners_test
