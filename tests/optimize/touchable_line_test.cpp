// What of a line a track can touch, held against curves that bend no more sharply.

#include "optimize/problem/touchable_line.hpp"

#include "glissade/core/vec.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/problem/feet.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "optimize/solved.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace touchable_line_test {

using namespace glissade;
using namespace glissade::optimizer;
using testing_problems::solved;

namespace {

constexpr double kRun = 10.0;

/// Ground of waves and scatter, drop over run.
std::vector<Vec2> rough_line(testing::Random& random, std::size_t corners, double scatter) {
  const double wave = random.between(0.3, 3.0);
  const double height = random.between(0.0, 0.4);
  const double slope = random.between(-0.5, 1.0);
  std::vector<Vec2> line;
  for (std::size_t i = 0; i < corners; ++i) {
    const double x = kRun * static_cast<double>(i) / static_cast<double>(corners - 1);
    line.push_back({x, slope * x + height * std::sin(x / wave) + scatter * random.between(-1.0, 1.0)});
  }
  return line;
}

double height_at(const std::vector<Vec2>& line, double x) {
  const auto above = std::upper_bound(line.begin() + 1, line.end() - 1, x,
                                      [](double value, Vec2 corner) { return value < corner.x; });
  const Vec2 a = *(above - 1);
  const Vec2 b = *above;
  return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

/// Arcs one behind the other with slopes below the vertical, no valley tighter than a radius: drop at each of many runs.
std::vector<Vec2> random_curve(testing::Random& random, double radius, double side) {
  constexpr double kStep = 1e-3;
  std::vector<Vec2> curve;
  double sine = random.between(-0.9, 0.9);  // of the slope, positive upwards
  double height = 0.0;
  double bend = 0.0;
  double left = 0.0;
  for (double x = 0.0; x <= kRun + kStep; x += kStep) {
    if (left <= 0.0) {
      left = random.between(0.1, 2.0);
      bend = random.between(0.0, 1.0) < 0.5 ? 1.0 / radius : random.between(-2.0, 1.0) / radius;
    }
    curve.push_back({x, -side * height});
    // The sine of the slope of an arc is linear in the run.
    const double next = sine + bend * kStep;
    if (std::fabs(next) > 0.99) {
      left = 0.0;
      bend = 0.0;
    }
    sine = std::clamp(next, -0.99, 0.99);
    height += kStep * sine / std::sqrt(1.0 - sine * sine);
    left -= kStep;
  }
  return curve;
}

}  // namespace

TEST_CASE("a curve that clears what can be touched of a line clears all of it, however rough that is") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t left_out = 0;
  std::size_t touched_again = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const double side = trial % 2 == 0 ? 1.0 : -1.0;
    const double radius = random.between(0.3, 6.0);
    const std::vector<Vec2> line = rough_line(random, 300, random.between(0.0, 0.3));
    const TouchableLine held = touchable(line, {side, radius, 0.0, kRun});
    REQUIRE(held.corners.size() == held.out_of_reach.size());
    left_out += line.size() - static_cast<std::size_t>(
                                  std::count(held.out_of_reach.begin(), held.out_of_reach.end(), false));
    // What stands for others lies behind them: the line held is nowhere in front of the one given.
    for (const Vec2 corner : line) CHECK(side * (height_at(held.corners, corner.x) - corner.y) >= -1e-9);
    std::vector<Vec2> curve = random_curve(random, radius, side);
    // Brought as near as the corners that can be touched let it.
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < held.corners.size(); ++i) {
      if (held.out_of_reach[i]) continue;
      least = std::min(least, side * (held.corners[i].y - height_at(curve, held.corners[i].x)));
    }
    for (Vec2& point : curve) point.y += side * least;
    double over_all = HUGE_VAL;
    for (const Vec2 corner : line)
      over_all = std::min(over_all, side * (corner.y - height_at(curve, corner.x)));
    CHECK(over_all > -1e-6);  // the curve's own steps
    if (over_all < 1e-6) ++touched_again;
  }
  CHECK(left_out > 3000);
  CHECK(touched_again == 60);
}

TEST_CASE("corners that an arc just reaches are kept, those behind it and no others are left out") {
  // A hollow of 2 m between two edges, an arc of radius 1.25 m through both hangs down 0.5 m.
  const auto kept = [](double depth, double radius, double from, double to) {
    const std::vector<Vec2> line{{0.0, 0.0}, {1.0, depth}, {2.0, 0.0}};
    return touchable(line, {1.0, radius, from, to}).out_of_reach == std::vector<bool>(3, false);
  };
  CHECK(kept(0.4999, 1.25, 0.0, 2.0));
  CHECK_FALSE(kept(0.5001, 1.25, 0.0, 2.0));
  CHECK(kept(0.5001, 1.24, 0.0, 2.0));
  // Where the track need not reach over both edges, and where the arc's lower half does not.
  CHECK(kept(0.6, 1.25, 0.1, 2.0));
  CHECK(kept(0.6, 1.25, 0.0, 1.9));
  CHECK(kept(3.0, 0.99, 0.0, 2.0));
  // Beside a cliff the arc through both edges goes round beyond its lower half.
  const std::vector<Vec2> cliff{{0.0, -3.0}, {0.1, 0.5}, {1.0, 0.0}};
  CHECK(touchable(cliff, {1.0, 1.8, 0.0, 1.0}).corners == cliff);
}

TEST_CASE("edges tell which points they concern as each point for itself does") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t concerned = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec2> points;
    double turn = 0.0;
    Vec2 at;
    for (int i = 0; i < 100; ++i) {
      points.push_back(at);
      turn += random.between(-0.2, 0.2);
      at = at + 0.1 * Vec2{std::cos(turn), std::sin(turn)};
    }
    const ConcernedPoints all(points);
    const std::vector<Vec2> line = rough_line(random, 40, 0.3);
    std::vector<std::size_t> found;
    for (std::size_t edge = 0; edge + 1 < line.size(); ++edge) {
      for (const double side : {1.0, -1.0}) {
        all.of_edge(line[edge], line[edge + 1], side, found);
        std::vector<std::size_t> one_by_one;
        for (std::size_t i = 0; i < points.size(); ++i) {
          if (concerns(points[i], line[edge], line[edge + 1], side)) one_by_one.push_back(i);
        }
        CHECK(found == one_by_one);
        concerned += found.size();
      }
    }
  }
  CHECK(concerned > 1000);
}

TEST_CASE("rough ground is held by what can be touched of it, to the same track") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const bool ceiling : {false, true}) {
    for (const double below : {0.0, 0.15}) {
      CAPTURE(ceiling, below);
      // 60 corners are all held; the same line with points on its edges is one of many corners.
      const std::vector<Vec2> line = [&] {
        std::vector<Vec2> corners;
        for (int i = 0; i < 60; ++i) {
          const double x = 10.0 * i / 59.0;
          const double arch = ceiling ? 0.7 * std::sin(0.1 * std::numbers::pi * x) - 0.35 : 0.0;
          corners.push_back({x, 0.5 * x + (ceiling ? arch : 0.45) + 0.15 * random.between(-1.0, 1.0)});
        }
        return corners;
      }();
      // Each with one of the two, elsewhere than in CI.
      if (ceiling == (below > 0.0) && !testing::thorough()) continue;
      std::vector<Vec2> of_many;
      for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        for (const double share : {0.0, 0.5}) of_many.push_back(line[i] + share * (line[i + 1] - line[i]));
      }
      of_many.push_back(line.back());
      const auto solved_with = [&](const std::vector<Vec2>& corners) {
        Problem problem;
        problem.endpoints = {10.0, 5.0};
        problem.body.friction = Friction::from_coefficient(0.15);
        problem.body.entry_speed = 1.0;
        problem.limits.smallest_valley_radius = 4.0;
        problem.limits.smallest_crest_radius = 4.0;
        problem.limits.envelope.below = below;
        problem.limits.envelope.above = below;
        (ceiling ? problem.limits.stay_below : problem.limits.stay_above) = {{corners, 0.02}};
        return problem;
      };
      const Problem few = solved_with(line);
      const Problem many = solved_with(of_many);
      const std::vector<bool>& behind = scaled(many, {}).obstacles.front().out_of_reach;
      CHECK(std::count(behind.begin(), behind.end(), true) > 3);
      CHECK(scaled(few, {}).obstacles.front().out_of_reach.empty());
      const OptimizeReport by_few = optimize(few).report;
      const OptimizeReport by_many = optimize(many).report;
      CHECK(by_few.status == by_many.status);
      // As exact as the order of answers to neighbouring problems.
      CHECK(by_many.travel_time == Approx(by_few.travel_time).epsilon(1e-5));
    }
  }
}

}  // namespace touchable_line_test
