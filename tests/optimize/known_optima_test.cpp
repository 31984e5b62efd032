// Limited problems whose optimum is known by another route: by hand, or on a fine mesh by a method that
// shares nothing with the search.

#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace glissade;

namespace {

constexpr double kGravity = 9.81;

double ramp_time(double length, double slope, double mu, double entry_speed) {
  const double pull = kGravity * (std::sin(slope) - mu * std::cos(slope));
  return (std::sqrt(entry_speed * entry_speed + 2.0 * pull * length) - entry_speed) / pull;
}

double solved_time(const Problem& problem, int pieces = OptimizeOptions{}.pieces) {
  OptimizeOptions options;
  options.pieces = pieces;
  const Optimum optimum = optimize(problem, options);
  INFO(optimum.report.brief());
  CHECK(optimum.report.status == OptimizeStatus::optimal);
  REQUIRE(optimum.centerline);
  for (const LimitCheck& check : optimum.report.checks) {
    INFO(check.limit << " reached " << check.reached);
    CHECK(check.kept());
  }
  return optimum.report.travel_time;
}

/// Frictionless least time from rest to (run, drop) above the line drop <= wall_slope x + wall_drop.
///
/// The optimum falls along a cycloid that touches the line, follows the line, and leaves it along another
/// cycloid that touches it. In contact both circles have rolled by theta, since a cycloid's slope is
/// cot(theta/2); the first circle is known by that, the second one by the place where it leaves, which is
/// found on a fine scan of the line from the condition that it passes through the finish.
double wall_reference(double run, double drop, double wall_slope, double wall_drop) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double theta = 2.0 * std::atan2(1.0, wall_slope);
  const double x_per_r = theta - std::sin(theta);
  const double y_per_r = 1.0 - std::cos(theta);
  const double r = wall_drop / (y_per_r - wall_slope * x_per_r);
  const double y_on = r * y_per_r;
  const double sine = wall_slope / std::hypot(1.0, wall_slope);
  struct Way {
    double miss = NAN;
    double time = 0.0;
  };
  const auto leaving_at = [&](double y, bool rising) {
    Way way;
    const double q = y / y_per_r;
    const double cosine = 1.0 - drop / q;
    if (cosine < -1.0) return way;
    const double end = rising ? kTurn - std::acos(cosine) : std::acos(cosine);
    if (end < theta) return way;
    way.miss = (y - wall_drop) / wall_slope + q * (end - std::sin(end) - x_per_r) - run;
    way.time = theta * std::sqrt(r / kGravity) +
               (std::sqrt(2.0 * kGravity * y) - std::sqrt(2.0 * kGravity * y_on)) / (kGravity * sine) +
               (end - theta) * std::sqrt(q / kGravity);
    return way;
  };
  constexpr int kScan = 4000;
  const double y_last = wall_slope * run + wall_drop;
  double least = HUGE_VAL;
  for (const bool rising : {false, true}) {
    for (int i = 0; i < kScan; ++i) {
      double low = y_on + (y_last - y_on) * i / kScan;
      double high = y_on + (y_last - y_on) * (i + 1) / kScan;
      const bool sign = leaving_at(low, rising).miss < 0.0;
      if (std::isnan(leaving_at(low, rising).miss) || std::isnan(leaving_at(high, rising).miss)) continue;
      if ((leaving_at(high, rising).miss < 0.0) == sign) continue;
      for (int step = 0; step < 100; ++step) {
        const double middle = 0.5 * (low + high);
        ((leaving_at(middle, rising).miss < 0.0) == sign ? low : high) = middle;
      }
      least = std::min(least, leaving_at(low, rising).time);
    }
  }
  return least;
}

}  // namespace

TEST_CASE("a slope limit at the mean slope leaves the straight ramp alone") {
  Problem problem;
  problem.endpoints = {12.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.1);
  const double mean = std::atan2(5.0, 12.0);
  problem.limits.slope_angle.highest = mean + 1e-6;
  CHECK(solved_time(problem) == Approx(ramp_time(13.0, mean, 0.1, 0.0)).epsilon(1e-5));
}

TEST_CASE(
    "a straight wall below: falling to it, along it and away from it takes the time of the closed forms") {
  // Frictionless, so that depth alone is speed.
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.0);
  for (const double wall_drop : {1.3, 1.6, 1.9}) {
    CAPTURE(wall_drop);
    const double slope = 0.4;
    problem.limits = {};
    problem.limits.half_planes.push_back({{0.0, wall_drop}, {-slope, 1.0}, 0.0});
    const double reference = wall_reference(10.0, 5.0, slope, wall_drop);
    CHECK(reference < 10.0);
    CHECK(solved_time(problem) == Approx(reference).epsilon(3e-7));
    CHECK(solved_time(problem) >= reference * (1.0 - 1e-8));
  }
}

TEST_CASE("a radius that joins two given straights is the arc between them") {
  // Entry along 45 deg, exit level, everything at the largest radius that fits: leads as long as the tangents
  // leave.
  const double radius = 8.0;
  const double turn = 0.25 * std::numbers::pi;
  const double lead = 2.0;
  const double tangent = radius * std::tan(0.5 * turn);
  Problem problem;
  problem.endpoints = {(lead + tangent) * std::cos(turn) + tangent + lead, (lead + tangent) * std::sin(turn)};
  problem.body.friction = Friction::from_coefficient(0.05);
  problem.limits.entry_slope_angle = Range::fixed(turn);
  problem.limits.slope_angle = {0.0, turn};
  problem.limits.exit_slope_angle = Range::fixed(0.0);
  problem.limits.smallest_valley_radius = radius;
  problem.limits.concave = true;
  const Optimum optimum = optimize(problem);
  INFO(optimum.report.brief());
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  // A steeper way down would be faster but is forbidden: the longest 45 deg there can be, then the tightest
  // turn. Speeds by Roberts' formula, v = A e^(2 mu zeta) + 2 g R [3 mu sin + (1 - 2 mu^2) cos]/(1 + 4 mu^2).
  const double mu = 0.05;
  const double v_in = 2.0 * kGravity * lead * (std::sin(turn) - mu * std::cos(turn));
  const auto circle = [&](double zeta) {
    return 2.0 * kGravity * radius * (3.0 * mu * std::sin(zeta) + (1.0 - 2.0 * mu * mu) * std::cos(zeta)) /
           (1.0 + 4.0 * mu * mu);
  };
  const double a = (v_in - circle(turn)) * std::exp(-2.0 * mu * turn);
  const auto v = [&](double zeta) { return a * std::exp(2.0 * mu * zeta) + circle(zeta); };
  constexpr int kSteps = 20000;
  double arc_time = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    arc_time += turn * radius / kSteps / std::sqrt(v(turn * (i + 0.5) / kSteps));
  }
  const double by_hand =
      ramp_time(lead, turn, mu, 0.0) + arc_time +
      (std::sqrt(v(0.0)) - std::sqrt(v(0.0) - 2.0 * mu * kGravity * lead)) / (mu * kGravity);
  // The search's curvature is continuous: it bends in and out over a piece, for which the arc alone has no
  // room.
  CHECK(optimum.report.travel_time >= by_hand * (1.0 - 1e-6));
  CHECK(optimum.report.travel_time == Approx(by_hand).epsilon(2e-3));
}
