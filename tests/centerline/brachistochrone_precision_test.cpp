#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/units.hpp"

#include "coulomb_quadrature.hpp"
#include "coulomb_reference.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace brachistochrone_precision_test {

using namespace glissade;
using reference::PreciseCurve;
using reference::SolutionErrors;

namespace {

/// A part of the reachable domain, by decimal exponents of the friction coefficient (none: no friction) and
/// of eps = drop/(mu run) - 1, or of drop/run where there is no friction.
struct Region {
  const char* name;
  bool friction;
  double least_friction, most_friction;
  double least_margin, most_margin;
};

constexpr Region kRegions[] = {
    {"no friction, drop/run 1e-4 to 1e4", false, 0.0, 0.0, -4.0, 4.0},
    {"mu 0.01 to 3, eps 1e-6 to 1e-3", true, -2.0, 0.4771, -6.0, -3.0},
    {"mu 0.01 to 3, eps 1e-3 to 1", true, -2.0, 0.4771, -3.0, 0.0},
    {"mu 0.01 to 3, eps 1 to 1e4", true, -2.0, 0.4771, 0.0, 4.0},
    {"mu 0.01 to 3, eps 1e4 to 1e12", true, -2.0, 0.4771, 4.0, 12.0},
    {"mu 1e-9 to 0.01, eps 1e-6 to 1", true, -9.0, -2.0, -6.0, 0.0},
    {"mu 1e-9 to 0.01, eps 1 to 1e12", true, -9.0, -2.0, 0.0, 12.0},
    {"mu 3 to 100, eps 1e-6 to 1e4", true, 0.4771, 2.0, -6.0, 4.0},
    {"mu 0.01 to 3, eps 1e-12 to 1e-6", true, -2.0, 0.4771, -12.0, -6.0},
};

struct Problem {
  Endpoints endpoints;
  Friction friction;
  double gravity;
};

Problem random_problem(testing::Random& random, const Region& region) {
  const double run = std::pow(10.0, random.between(-3.0, 5.0));
  const double margin = std::pow(10.0, random.between(region.least_margin, region.most_margin));
  const double gravity = random.between(1.0, 30.0);
  if (!region.friction) return {{run, run * margin}, Friction{}, gravity};
  const double mu = std::pow(10.0, random.between(region.least_friction, region.most_friction));
  return {{run, mu * run * (1.0 + margin)}, Friction::from_coefficient(mu), gravity};
}

/// Slope angles spread over the track, the first and the last close to its ends. The double pi/2 stands for
/// the start, those next to the exit slope angle for the finish.
std::vector<double> slope_angles_of(const CoulombSolution& solution) {
  const double last = std::nextafter(solution.exit_slope_angle.radians(), kRightAngle);
  std::vector<double> angles;
  for (const double part : {1e-6, 0.1, 0.5, 0.9, 0.9999}) {
    const double angle = kRightAngle + part * (solution.exit_slope_angle.radians() - kRightAngle);
    if (angle < kRightAngle && angle > last) angles.push_back(angle);
  }
  return angles;
}

std::string describe(const Problem& problem) {
  char text[200];
  std::snprintf(text, sizeof text, "mu %.17g, run %.17g, drop %.17g, gravity %.17g",
                problem.friction.coefficient(), problem.endpoints.run, problem.endpoints.drop,
                problem.gravity);
  return text;
}

SolutionErrors largest(const SolutionErrors& a, const SolutionErrors& b, double weight) {
  return {std::max(a.travel_time, weight * b.travel_time),
          std::max(a.exit_speed, weight * b.exit_speed),
          std::max(a.exit_slope_angle, weight * b.exit_slope_angle),
          std::max(a.straight_time, weight * b.straight_time),
          std::max(a.x, weight * b.x),
          std::max(a.drop, weight * b.drop),
          std::max(a.time, weight * b.time),
          std::max(a.speed, weight * b.speed)};
}

}  // namespace

TEST_CASE("fastest track: quadrature of the theory's integrals in 34 digits confirms every number") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr int kProblemsPerRegion = 60;
  for (const Region& region : kRegions) {
    for (int i = 0; i < kProblemsPerRegion; ++i) {
      const Problem problem = random_problem(random, region);
      INFO(region.name << ": " << describe(problem));
      const double tolerance = coulomb_accuracy(reference::reach_margin(problem.endpoints, problem.friction));
      const CoulombSolution solution =
          solve_coulomb_brachistochrone(problem.endpoints, problem.friction, problem.gravity);
      const SolutionErrors errors = PreciseCurve(solution).errors(slope_angles_of(solution));
      CHECK(errors.travel_time <= tolerance);
      CHECK(errors.exit_speed <= tolerance);
      CHECK(errors.exit_slope_angle <= tolerance);
      CHECK(errors.straight_time <= tolerance);
      CHECK(errors.x <= tolerance);
      CHECK(errors.drop <= tolerance);
      CHECK(errors.time <= tolerance);
      CHECK(errors.speed <= tolerance);
    }
  }
}

TEST_CASE("fastest track: quadrature of its arc length confirms the position at any arc length") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr int kProblemsPerRegion = 4;
  for (const Region& region : kRegions) {
    for (int i = 0; i < kProblemsPerRegion; ++i) {
      const Problem problem = random_problem(random, region);
      INFO(region.name << ": " << describe(problem));
      const CoulombBrachistochrone track(problem.endpoints, problem.friction, problem.gravity);
      const PreciseCurve precise(track.solution());
      for (const double slope_angle : slope_angles_of(track.solution())) {
        INFO("slope angle " << slope_angle);
        CHECK(precise.position_error(track, slope_angle) <= CoulombBrachistochrone::kPositionAccuracy);
      }
    }
  }
}

TEST_CASE("fastest track: the errors reached, region by region", "[.accuracy]") {
  testing::Random random = testing::seeded_random();
  constexpr int kProblemsPerRegion = 2000;
  constexpr int kCurvesPerRegion = 50;
  std::printf("seed %llu, %d problems and %d curves a region; largest relative error\n",
              static_cast<unsigned long long>(random.seed()), kProblemsPerRegion, kCurvesPerRegion);
  std::printf(
      "| region | travel time | exit speed | exit slope | straight | x | drop | time | speed | of bound | "
      "position by s |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Region& region : kRegions) {
    SolutionErrors worst;
    SolutionErrors of_bound;
    for (int i = 0; i < kProblemsPerRegion; ++i) {
      const Problem problem = random_problem(random, region);
      const double tolerance = coulomb_accuracy(reference::reach_margin(problem.endpoints, problem.friction));
      const CoulombSolution solution =
          solve_coulomb_brachistochrone(problem.endpoints, problem.friction, problem.gravity);
      const SolutionErrors errors = PreciseCurve(solution).errors(slope_angles_of(solution));
      worst = largest(worst, errors, 1.0);
      of_bound = largest(of_bound, errors, 1.0 / tolerance);
    }
    double off_curve = 0.0;
    for (int i = 0; i < kCurvesPerRegion; ++i) {
      const Problem problem = random_problem(random, region);
      const CoulombBrachistochrone track(problem.endpoints, problem.friction, problem.gravity);
      const PreciseCurve precise(track.solution());
      for (const double slope_angle : slope_angles_of(track.solution())) {
        off_curve = std::max(off_curve, precise.position_error(track, slope_angle));
      }
    }
    const double share =
        std::max({of_bound.travel_time, of_bound.exit_speed, of_bound.exit_slope_angle,
                  of_bound.straight_time, of_bound.x, of_bound.drop, of_bound.time, of_bound.speed});
    std::printf("| %s | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e | %.3f | %.1e |\n", region.name,
                worst.travel_time, worst.exit_speed, worst.exit_slope_angle, worst.straight_time, worst.x,
                worst.drop, worst.time, worst.speed, share, off_curve);
  }
}

}  // namespace brachistochrone_precision_test
