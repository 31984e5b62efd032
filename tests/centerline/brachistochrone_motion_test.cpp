#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/cycloid.hpp"
#include "glissade/centerline/no_curvature_load.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>

namespace brachistochrone_motion_test {

using namespace glissade;

namespace {

struct Problem {
  Endpoints endpoints;
  Friction friction;
};

Problem random_problem(testing::Random& random) {
  const double mu = random.between(0.0, 1.0);
  const double run = std::pow(10.0, random.between(-2.0, 3.0));
  return {{run, run * (mu + std::pow(10.0, random.between(-1.3, 1.3)))}, Friction::from_coefficient(mu)};
}

/// A fastest track bent: its slope angle plus a sum of sines of arc length, its length stretched.
class BentTrack : public Centerline {
 public:
  static constexpr std::size_t kSines = 4;

  BentTrack(std::shared_ptr<const CoulombBrachistochrone> base, std::array<double, kSines> amplitudes,
            double stretch)
      : base_(std::move(base)), amplitudes_(amplitudes), stretch_(stretch) {}

  [[nodiscard]] std::string_view kind() const noexcept override { return "bent"; }
  [[nodiscard]] double length() const noexcept override { return base_->length() * stretch_; }
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override { return true; }
  [[nodiscard]] Direction direction(double s) const override {
    Direction bent = base_->direction(std::min(s / stretch_, base_->length()));
    bent.curvature /= stretch_;
    for (std::size_t i = 0; i < kSines; ++i) {
      const double wave = static_cast<double>(i + 1) * std::numbers::pi / length();
      bent.slope_angle += amplitudes_[i] * std::sin(wave * s);
      bent.curvature -= amplitudes_[i] * wave * std::cos(wave * s);
    }
    return bent;
  }
  [[nodiscard]] double slope_angle(double s) const override { return direction(s).slope_angle; }
  [[nodiscard]] CenterlinePoint at(double s) const override {
    const Direction bent = direction(s);
    return {s, integral(s, [](double angle) { return std::cos(angle); }),
            integral(s, [](double angle) { return std::sin(angle); }), bent.slope_angle, bent.curvature};
  }

 private:
  template <class Function>
  double integral(double s, const Function& function) const {
    constexpr int kPanels = 16;
    const double width = std::sqrt(s) / kPanels;  // over sqrt(s), in which a vertical start is smooth
    double sum = 0.0;
    for (int i = 0; i < kPanels; ++i) {
      const auto integrand = [&](double root) { return 2.0 * root * function(slope_angle(root * root)); };
      sum += boost::math::quadrature::gauss<double, 15>::integrate(integrand, i * width, (i + 1) * width);
    }
    return sum;
  }

  std::shared_ptr<const CoulombBrachistochrone> base_;
  std::array<double, kSines> amplitudes_;
  double stretch_;
};

/// Bends `base` by given second and third sines and a stretch; the first and the fourth sine bring its end
/// back to the finish.
CenterlinePtr bent_to_finish(const std::shared_ptr<const CoulombBrachistochrone>& base, double second,
                             double third, double stretch) {
  const Endpoints wanted = base->endpoints();
  double first = 0.0;
  double fourth = 0.0;
  const auto miss = [&](double a, double b) {
    const Endpoints end = BentTrack(base, {a, second, third, b}, stretch).endpoints();
    return Endpoints{end.run - wanted.run, end.drop - wanted.drop};
  };
  for (int step = 0; step < 12; ++step) {
    constexpr double kStep = 1e-6;
    const Endpoints at = miss(first, fourth);
    const Endpoints by_first = miss(first + kStep, fourth);
    const Endpoints by_fourth = miss(first, fourth + kStep);
    const double run_first = (by_first.run - at.run) / kStep;
    const double run_fourth = (by_fourth.run - at.run) / kStep;
    const double drop_first = (by_first.drop - at.drop) / kStep;
    const double drop_fourth = (by_fourth.drop - at.drop) / kStep;
    const double determinant = run_first * drop_fourth - run_fourth * drop_first;
    first -= (at.run * drop_fourth - at.drop * run_fourth) / determinant;
    fourth -= (run_first * at.drop - drop_first * at.run) / determinant;
  }
  const Endpoints left = miss(first, fourth);
  REQUIRE(std::hypot(left.run, left.drop) <= 1e-12 * base->length());
  return std::make_shared<BentTrack>(
      base, std::array<double, BentTrack::kSines>{first, second, third, fourth}, stretch);
}

}  // namespace

TEST_CASE("fastest track: the referee finds its travel time, exit speed and the body on its way") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 40; ++i) {
    const Problem problem = random_problem(random);
    INFO("mu " << problem.friction.coefficient() << ", run " << problem.endpoints.run << ", drop "
               << problem.endpoints.drop);
    const auto track = std::make_shared<const CoulombBrachistochrone>(problem.endpoints, problem.friction);
    const Motion ride(track, Body{problem.friction, 0.0, 0.0});
    REQUIRE(ride.arrived());
    CHECK(ride.travel_time() == Approx(track->solution().travel_time).epsilon(kMotionAccuracy));
    CHECK(ride.exit_speed() == Approx(track->solution().exit_speed).epsilon(kMotionAccuracy));
    for (const double part : {1e-4, 0.1, 0.5, 0.9}) {
      const double s = part * track->length();
      const MotionState ridden = ride.at(s);
      const CoulombState expected = track->state_at(s);
      CHECK(ridden.time == Approx(expected.time).epsilon(kMotionAccuracy));
      CHECK(ridden.speed == Approx(expected.speed).epsilon(kMotionAccuracy));
    }
  }
}

TEST_CASE(
    "fastest track: beside the limit of what can be reached the referee knows the energy of the slow body") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 60; ++i) {
    const Friction friction = Friction::from_coefficient(random.between(0.02, 3.0));
    const double run = std::pow(10.0, random.between(-1.0, 3.0));
    const double margin = std::pow(10.0, random.between(-4.0, -0.5));
    const Endpoints ends{run, run * friction.coefficient() * (1.0 + margin)};
    INFO("mu " << friction.coefficient() << ", run " << run << ", drop above the limit by " << margin
               << " of it");
    const auto track = std::make_shared<const CoulombBrachistochrone>(ends, friction);
    const Motion ride(track, Body{friction, 0.0, 0.0});
    REQUIRE(ride.arrived());
    CHECK(ride.travel_time() == Approx(track->solution().travel_time).epsilon(kMotionAccuracy));
    const double highest = ride.highest_speed().speed;
    const double was = track->solution().exit_speed;
    CHECK(std::fabs(ride.exit_speed() * ride.exit_speed() - was * was) <=
          kMotionEnergyAccuracy * highest * highest);
  }
}

TEST_CASE("fastest track: the body never leaves it, and its speed obeys the reach theorem") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 2000; ++i) {
    const Problem problem = random_problem(random);
    const CoulombSolution solution = solve_coulomb_brachistochrone(problem.endpoints, problem.friction);
    const double mu = problem.friction.coefficient();
    const double friction_angle = problem.friction.angle().radians();
    INFO("mu " << mu << ", run " << problem.endpoints.run << ", drop " << problem.endpoints.drop);
    CHECK(solution.travel_time < solution.straight_time);
    CHECK(solution.exit_slope_angle.radians() > 2.0 * friction_angle - std::numbers::pi / 2.0);
    CHECK(solution.exit_speed * solution.exit_speed <=
          2.0 * solution.gravity * (problem.endpoints.drop - mu * problem.endpoints.run) *
              std::exp(2.0 * mu * (solution.exit_slope_angle.radians() - friction_angle)) * (1.0 + 1e-12));
    for (const double part : {0.01, 0.3, 0.7, 1.0}) {
      const double angle =
          std::numbers::pi / 2.0 + part * (solution.exit_slope_angle.radians() - std::numbers::pi / 2.0);
      const CoulombState state = solution.at_slope_angle(Angle::from_radians(angle));
      CHECK(state.curvature > 0.0);
      CHECK(solution.gravity * std::cos(angle) + state.curvature * state.speed * state.speed > 0.0);
    }
  }
}

TEST_CASE("fastest track: bending it costs time, and the cost grows with the square of the bend") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const Problem& problem :
       {Problem{{10.0, 5.0}, Friction{}}, Problem{{10.0, 5.0}, Friction::from_coefficient(0.2)},
        Problem{{10.0, 5.0}, Friction::from_coefficient(0.4)},
        Problem{{10.0, 12.0}, Friction::from_coefficient(0.8)}}) {
    const auto base = std::make_shared<const CoulombBrachistochrone>(problem.endpoints, problem.friction);
    const Body body{problem.friction, 0.0, 0.0};
    const double second = random.between(0.02, 0.03);
    const double third = random.between(-0.03, -0.02);
    const double stretch = random.between(-0.002, 0.002);
    INFO("mu " << problem.friction.coefficient() << ", bend " << second << " " << third << " " << stretch);
    const auto cost = [&](double size) {
      const CenterlinePtr bent = bent_to_finish(base, size * second, size * third, 1.0 + size * stretch);
      const Motion ride(bent, body);
      REQUIRE(ride.arrived());
      return ride.travel_time() - base->solution().travel_time;
    };
    const double small = cost(0.05) + cost(-0.05);  // the sum leaves only even powers of the bend
    const double large = cost(0.1) + cost(-0.1);
    CHECK(cost(0.25) > 0.0);
    CHECK(cost(-0.25) > 0.0);
    CHECK(large / small == Approx(4.0).epsilon(0.02));
    // Stationary: what is odd in the bend is small against what is even.
    CHECK(std::fabs(cost(0.05) - cost(-0.05)) < 0.2 * (cost(0.05) + cost(-0.05)));
  }
}

TEST_CASE("fastest track: no other kind of centerline between the same points is faster") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 20; ++i) {
    const Problem problem = random_problem(random);
    INFO("mu " << problem.friction.coefficient() << ", run " << problem.endpoints.run << ", drop "
               << problem.endpoints.drop);
    const double least = solve_coulomb_brachistochrone(problem.endpoints, problem.friction).travel_time;
    const std::vector<CenterlinePtr> others = {
        std::make_shared<Cycloid>(problem.endpoints),
        std::make_shared<NoCurvatureLoadCurve>(problem.endpoints, problem.friction)};
    for (const CenterlinePtr& other : others) {
      const Motion ride(other, Body{problem.friction, 0.0, 0.0});
      if (ride.arrived()) CHECK(ride.travel_time() >= least * (1.0 - kMotionAccuracy));
    }
  }
}

}  // namespace brachistochrone_motion_test
