// The referee looks at places; what lies between them counts all the same.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/optimize/optimize.hpp"

#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <catch2/catch.hpp>

namespace between_samples_test {

using namespace glissade;

namespace {

const LimitCheck& check_of(const std::vector<LimitCheck>& checks, const LimitName& limit) {
  return *std::find_if(checks.begin(), checks.end(),
                       [&](const LimitCheck& check) { return check.limit == limit; });
}

/// Waves that a body at 15 m/s follows: a slope that is steepest within its pieces.
std::shared_ptr<const ClothoidSpline> waves(testing::Random& random) {
  std::vector<ClothoidSegment> segments;
  double curvature = random.between(-0.01, 0.01);
  for (int i = 0; i < 8; ++i) {
    const double next = random.between(0.001, 0.01) * (curvature > 0.0 ? -1.0 : 1.0);
    segments.push_back({random.between(2.0, 9.0), curvature, next});
    curvature = next;
  }
  return std::make_shared<const ClothoidSpline>(Angle::from_degrees(25.0), std::move(segments));
}

/// The steepest slope, by its parabola in each segment.
double steepest(const ClothoidSpline& track) {
  double angle = track.entry_slope_angle().radians();
  double most = angle;
  for (const ClothoidSegment& segment : track.segments()) {
    const double rate = (segment.exit_curvature - segment.entry_curvature) / segment.length;
    const double where = -segment.entry_curvature / rate;
    // A positive curvature makes the track flatter.
    if (where > 0.0 && where < segment.length)
      most = std::max(most, angle - 0.5 * segment.entry_curvature * where);
    angle -= 0.5 * (segment.entry_curvature + segment.exit_curvature) * segment.length;
    most = std::max(most, angle);
  }
  return most;
}

}  // namespace

TEST_CASE("referee: a load that bends sharply on a piece short for its track is found to all digits",
          "[limits]") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int within = 0;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    // Few samples lie on the middle piece: it takes up a hundredth of the track. Down to it the speed stays as it is.
    const Angle slope = Angle::from_degrees(random.between(25.0, 35.0));
    const double curvature = random.between(0.1, 0.2);
    const double length = random.between(4.0, 8.0);
    const auto track = std::make_shared<const ClothoidSpline>(
        slope, std::vector<ClothoidSegment>{{400.0, 0.0, 0.0},
                                            {2.0, 0.0, -curvature},
                                            {length, -curvature, curvature * random.between(0.8, 1.2)},
                                            {2.0, curvature, 0.0},
                                            {300.0, 0.0, 0.0}});
    Problem problem;
    problem.endpoints = track->endpoints();
    problem.body.friction = Friction::from_angle(slope);
    problem.body.entry_speed = random.between(4.0, 5.0);
    problem.limits.lowest_normal_load = 0.1;
    const Motion motion(track, problem.body, problem.gravity);
    const std::vector<LimitCheck> checks = check_limits(problem, track);
    double least = HUGE_VAL;
    const double end = std::min(motion.distance(), 410.0);
    constexpr int kSamples = 20000;
    double where = 0.0;
    for (int k = 0; k <= kSamples; ++k) {
      const MotionState state = motion.at(std::min(end, 400.0 + (end - 400.0) * k / kSamples));
      if (state.normal_load < least) where = state.arc_length;
      least = std::min(least, state.normal_load);
    }
    if (where > 402.1 && where < 401.9 + length) ++within;
    const LimitCheck& load = check_of(checks, {LimitId::lowest_normal_load, Bound::lowest});
    CHECK(load.reached <= least + 1e-8);
  }
  CHECK(within > 5);
}

TEST_CASE("referee: slopes, loads and speeds that are greatest between samples are found", "[limits]") {
  testing::Random random = testing::seeded_random();
  for (int i = 0; i < 50; ++i) {
    CAPTURE(i);
    const auto track = waves(random);
    Problem problem;
    problem.endpoints = track->endpoints();
    problem.body.friction = Friction::from_coefficient(random.between(0.0, 0.5));
    problem.body.entry_speed = 15.0;
    problem.limits.slope_angle.highest = 0.1;
    problem.limits.highest_normal_load = 1.0;
    problem.limits.lowest_normal_load = 20.0;
    problem.limits.speed.highest = 1.0;
    const Motion motion(track, problem.body, problem.gravity);
    REQUIRE(motion.arrived());
    const std::vector<LimitCheck> checks = check_limits(problem, track);
    const auto reached = [&](LimitId id, Bound bound) { return check_of(checks, {id, bound}).reached; };
    CHECK(reached(LimitId::slope_angle, Bound::highest) == Approx(steepest(*track)).epsilon(1e-12));
    CHECK(reached(LimitId::highest_normal_load, Bound::highest) ==
          Approx(motion.highest_load().normal_load).epsilon(1e-8));
    CHECK(reached(LimitId::lowest_normal_load, Bound::lowest) ==
          Approx(motion.lowest_load().normal_load).epsilon(1e-8));
    CHECK(reached(LimitId::speed, Bound::highest) == Approx(motion.highest_speed().speed).epsilon(1e-9));
  }
}

TEST_CASE("referee: where a body leaves its track is looked at, on the side that it came from", "[limits]") {
  const double rest =
      -0.8;  // curvature after the straight, or at the end of a bend: far too much for the body
  const double steep = 0.5;
  for (const bool jump : {true, false}) {
    CAPTURE(jump);
    const auto track = std::make_shared<const ClothoidSpline>(
        Angle::from_radians(steep),
        std::vector<ClothoidSegment>{{7.3, 0.0, 0.0}, {1.0, jump ? rest : 0.0, rest}});
    Problem problem;
    problem.endpoints = track->endpoints();
    problem.body.friction = Friction::from_coefficient(0.1);
    const Motion motion(track, problem.body, problem.gravity);
    REQUIRE(motion.lift_off());
    CHECK((motion.distance() == 7.3) == jump);
    problem.limits.speed.highest = motion.exit_speed() * (1.0 - 1e-5);
    const std::vector<LimitCheck> checks = check_limits(problem, track);
    const LimitCheck& speed = check_of(checks, {LimitId::speed, Bound::highest});
    CHECK_FALSE(speed.kept());
    CHECK(speed.reached == Approx(motion.exit_speed()).epsilon(1e-12));
    CHECK(speed.where == Approx(motion.distance()).epsilon(1e-12));
    const LimitCheck& load = check_of(checks, {LimitId::lowest_normal_load, Bound::lowest});
    CHECK(load.reached == Approx(motion.lowest_load().normal_load).epsilon(1e-9).margin(1e-6));
    CHECK(load.reached > -1e-6);
    CHECK(load.leaves_track);
    CHECK_FALSE(load.kept());
  }
}

}  // namespace between_samples_test
