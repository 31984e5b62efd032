// The bound that the energy equation sets to slowness, against rides on random tracks.

#include "optimize/conflicts/energy_left.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace energy_left_test {

using namespace glissade;
using optimizer::least_speed_left;
using optimizer::most_speed_left;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Slope angles that wander within bounds, as arcs.
std::shared_ptr<ClothoidSpline> wandering(testing::Random& random, double flattest, double steepest) {
  double slope = random.between(flattest, steepest);
  const double entry = slope;
  std::vector<ClothoidSegment> segments;
  for (int i = random.integer(2, 12); i > 0; --i) {
    const double next = random.between(flattest, steepest);
    const double length = random.between(0.3, 3.0);
    const double curvature = (slope - next) / length;
    segments.push_back({length, curvature, curvature});
    slope = next;
  }
  return std::make_shared<ClothoidSpline>(Angle::from_radians(entry), std::move(segments));
}

}  // namespace

TEST_CASE("no ride within slopes leaves less speed than the energy equation says") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int arrived = 0;
  int close = 0;
  for (int i = 0; i < 2000; ++i) {
    Problem problem;
    const double flattest = random.between(-40.0, 20.0) * kDegree;
    const double steepest = random.between(30.0, 89.0) * kDegree;
    const auto track = wandering(random, flattest, steepest);
    const CenterlinePoint end = track->at(track->length());
    problem.endpoints = {end.x, end.drop};
    problem.body.friction = Friction::from_coefficient(random.between(0.0, 0.5));
    if (random.integer(0, 1) == 1) problem.body.entry_speed = random.between(0.5, 4.0);
    problem.limits.slope_angle = {flattest, steepest};
    const Motion motion(track, problem.body, problem.gravity);
    if (!motion.arrived()) continue;
    ++arrived;
    const std::optional<double> least = least_speed_left(problem);
    if (!least) continue;
    CAPTURE(i, flattest, steepest, problem.body.friction.coefficient());
    const double left = motion.exit_speed();
    CHECK(left >= *least * (1.0 - 1e-6));
    close += left < 1.1 * *least ? 1 : 0;
  }
  CAPTURE(arrived, close);
  CHECK(arrived > 200);
  // It says something.
  CHECK(close > arrived / 20);
}

TEST_CASE("without friction the speed at the finish is known; with it two slopes rub off the most") {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  CHECK(least_speed_left(problem).value() == Approx(std::sqrt(2.0 * problem.gravity * 5.0)).epsilon(1e-14));
  // h of docs/optimization.md is concave between the two: its envelope there is the chord.
  problem.endpoints = {8.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.25);
  problem.limits.slope_angle = {9.0 * kDegree, 60.0 * kDegree};
  const auto h = [&](double q) { return 2.0 * problem.gravity * (q - 0.25) * std::exp(-0.5 * std::atan(q)); };
  const double flat = std::tan(9.0 * kDegree);
  const double steep = std::tan(60.0 * kDegree);
  const double chord = h(flat) + (5.0 / 8.0 - flat) / (steep - flat) * (h(steep) - h(flat));
  const double speed = std::sqrt(8.0 * chord * std::exp(0.5 * 9.0 * kDegree));
  CHECK(least_speed_left(problem).value() == Approx(speed).epsilon(1e-4));
  CHECK(*least_speed_left(problem) < speed);
  // Where a track may climb as steeply as it likes there is no bound, nor with drag.
  problem.limits.slope_angle.lowest.reset();
  CHECK(!least_speed_left(problem));
  problem.limits.slope_angle.lowest = 9.0 * kDegree;
  problem.body.drag_per_metre = 0.01;
  CHECK(!least_speed_left(problem));
}

TEST_CASE("no ride is faster at its finish than the energy equation says, whatever its shape") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int arrived = 0;
  int tight = 0;
  for (int i = 0; i < 2000; ++i) {
    Problem problem;
    const double flattest = random.between(-70.0, 20.0) * kDegree;
    const double steepest = random.between(30.0, 89.0) * kDegree;
    const auto track = wandering(random, flattest, steepest);
    const CenterlinePoint end = track->at(track->length());
    problem.endpoints = {end.x, end.drop};
    problem.body.friction = Friction::from_coefficient(random.between(0.0, 0.5));
    if (random.integer(0, 1) == 1) problem.body.entry_speed = random.between(0.5, 4.0);
    if (random.integer(0, 2) == 0) problem.body.drag_per_metre = random.between(0.0, 0.05);
    if (problem.body.drag_per_metre > 0.0) problem.body.head_wind = random.between(0.0, 5.0);
    if (random.integer(0, 1) == 1) problem.limits.slope_angle = {flattest, steepest};
    const Motion motion(track, problem.body, problem.gravity);
    if (!motion.arrived()) continue;
    ++arrived;
    CAPTURE(i, flattest, steepest, problem.body.friction.coefficient());
    const std::optional<double> most = most_speed_left(problem);
    REQUIRE(most);
    CHECK(motion.exit_speed() <= *most * (1.0 + 1e-9));
    // Friction has its part in it.
    const double entry = problem.body.entry_speed;
    const double frictionless = std::sqrt(entry * entry + 2.0 * problem.gravity * end.drop);
    CHECK(*most <= frictionless * (1.0 + 1e-12));
    tight += *most < 0.99 * frictionless ? 1 : 0;
  }
  CAPTURE(arrived, tight);
  CHECK(arrived > 150);
  CHECK(tight > arrived / 10);
}

TEST_CASE("a straight line is as fast as the energy equation allows within its slope") {
  Problem problem;
  problem.endpoints = {8.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.25);
  const double slope = std::atan2(5.0, 8.0);
  problem.limits.slope_angle = {slope, slope};
  const double along = std::sqrt(2.0 * problem.gravity * (5.0 - 0.25 * 8.0));
  CHECK(most_speed_left(problem).value() == Approx(along).epsilon(1e-12));
}

TEST_CASE("where energy may be added, or the finish lie as deep as one likes, no highest speed is known") {
  Problem problem;
  problem.endpoints = {8.0, 5.0};
  const double fallen = std::sqrt(2.0 * problem.gravity * 5.0);
  CHECK(most_speed_left(problem).value() == Approx(fallen).epsilon(1e-14));
  problem.body.drag_per_metre = 0.01;
  problem.body.head_wind = -20.0;
  CHECK(!most_speed_left(problem));
  problem.body.head_wind = 20.0;
  CHECK(most_speed_left(problem).value() == Approx(fallen).epsilon(1e-14));
  problem.finish.kind = FinishKind::vertical_line;
  CHECK(!most_speed_left(problem));
  problem.finish.free_range.highest = 20.0;
  CHECK(most_speed_left(problem).value() == Approx(2.0 * fallen).epsilon(1e-14));
}

TEST_CASE(
    "a lowest speed that begins before a fall gives it is called infeasible, one that begins later is not") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < (testing::thorough() ? 6 : 2); ++i) {
    Problem problem;
    problem.endpoints = {10.0, random.between(4.0, 9.0)};
    problem.body.friction = Friction::from_coefficient(random.between(0.0, 0.1));
    problem.body.entry_speed = i % 2 == 0 ? 0.0 : random.between(0.1, 2.0);
    const double from = random.between(0.2, 1.5);
    problem.limits.lowest_speed_from = from;
    const double most = optimizer::most_speed_after(problem, from).value();
    CHECK(most == Approx(std::sqrt(problem.body.entry_speed * problem.body.entry_speed +
                                   2.0 * problem.gravity * from)));
    CAPTURE(i, from, most);
    problem.limits.speed.lowest = 1.01 * most;
    const OptimizeReport none = optimize(problem).report;
    CHECK(none.status == OptimizeStatus::infeasible);
    REQUIRE(none.conflict.limits.size() == 1);
    CHECK(none.conflict.limits.front().limit == LimitName{LimitId::speed, Bound::lowest});
    CHECK_THAT(none.conflict.text + none.conflict.why,
               Catch::Matchers::Contains("Whatever the shape of the track, a fall of ") &&
                   Catch::Matchers::Contains("lowest_from has to be more than that"));
    problem.limits.speed.lowest = 0.9 * most;
    CHECK(optimize(problem).centerline != nullptr);
  }
  // A wind from behind may give it.
  Problem pushed;
  pushed.endpoints = {10.0, 5.0};
  pushed.body.drag_per_metre = 0.01;
  pushed.body.head_wind = -20.0;
  CHECK_FALSE(optimizer::most_speed_after(pushed, 1.0));
}

}  // namespace energy_left_test
