// Steps from afar, on one mesh: wherever they begin they end on the same track, and where limits contradict each other
// where another search lowers the violation no further.

#include "optimize/descent/elastic_descent.hpp"

#include "glissade/task/problem.hpp"

#include "optimize/descent/least_violation.hpp"
#include "optimize/discretise/guess.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>

namespace elastic_descent_test {

using namespace glissade;
using namespace glissade::optimizer;

namespace {

Problem ramp() {
  Problem problem;
  problem.endpoints = {10.0, 5.0};
  problem.body.friction = Friction::from_coefficient(0.2);
  return problem;
}

/// A straight line bent at random, but not uphill, of another length than it has.
GuessCurve bent(const ScaledProblem& problem, testing::Random& random) {
  GuessCurve curve;
  constexpr int kSteps = 64;
  const double mean = std::atan2(problem.drop, problem.run);
  const double amplitude = random.between(-0.3, 0.3);
  const double waves = random.between(0.2, 1.0);
  const double phase = random.between(0.0, 6.0);
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    curve.sigma.push_back(share);
    curve.zeta.push_back(mean + 0.2 * (1.0 - 2.0 * share) +
                         amplitude * std::sin(6.0 * waves * share + phase));
  }
  curve.length = random.between(0.8, 1.4);
  return curve;
}

/// One problem on one mesh.
struct Setting {
  explicit Setting(const Problem& limited)
      : problem(scaled(limited, {})),
        mesh(mesh_of(problem, graded_knots(brachistochrone_guess(problem.run, problem.drop, 0.2), 16, 0.0),
                     1.1)),
        track(mesh),
        rows(problem, track) {}

  [[nodiscard]] ElasticEnd from(const GuessCurve& curve, double near) {
    return descend_elastically(rows, track, fit(curve, track), {}, near, control);
  }
  [[nodiscard]] double violation(const Vector& z) const {
    const State state = rows.state(z, false);
    double greatest = 0.0;
    for (const double value : rows.equality_values(state)) greatest = std::max(greatest, std::fabs(value));
    for (const Row& row : rows.candidates(state, 0.0)) greatest = std::max(greatest, rows.value(state, row));
    return greatest;
  }
  [[nodiscard]] double objective(const Vector& z) const { return rows.objective(rows.state(z, false)); }

  ScaledProblem problem;
  Mesh mesh;
  Transcription track;
  Rows rows;
  SearchControl control;
};

}  // namespace

TEST_CASE("elastic steps end on one track, whatever track they begin with") {
  Problem limited = ramp();
  limited.limits.slope_angle.highest = 0.9;
  limited.limits.exit_slope_angle = Range::fixed(0.3);
  limited.limits.smallest_valley_radius = 4.0;
  limited.limits.highest_normal_load = 14.0;
  Setting setting(limited);
  testing::Random random = testing::seeded_random();
  double least = HUGE_VAL;
  double greatest = 0.0;
  for (int i = 0; i < 20; ++i) {
    const ElasticEnd end = setting.from(bent(setting.problem, random), 1e-6);
    CAPTURE(i);
    CHECK(end.violation <= 1e-6);
    CHECK(end.violation == Approx(setting.violation(end.z)).margin(1e-12));
    least = std::min(least, setting.objective(end.z));
    greatest = std::max(greatest, setting.objective(end.z));
  }
  // 1e-6 of the gradient left is 1e-12 of the objective.
  CHECK(greatest <= least * (1.0 + 1e-9));
}

TEST_CASE("elastic steps end at a least violation where limits contradict each other") {
  Problem limited = ramp();
  SECTION("a mean slope that is steeper than the steepest") {
    limited.limits.slope_angle.highest = 0.4;
  }
  SECTION("a bend that does not fit between a steep entry and a steep exit") {
    limited.limits.entry_slope_angle = Range::fixed(1.0);
    limited.limits.exit_slope_angle = Range::fixed(-0.3);
    limited.limits.smallest_valley_radius = 40.0;
  }
  Setting setting(limited);
  testing::Random random = testing::seeded_random();
  const Vector margins(setting.problem.limits.size(), 0.0);
  for (int i = 0; i < 5; ++i) {
    const ElasticEnd end = setting.from(bent(setting.problem, random), 1e-6);
    CHECK(end.violation == Approx(setting.violation(end.z)).margin(1e-12));
    CHECK(end.violation > 1e-3);
    const Relaxed relaxed =
        least_violation(setting.problem, setting.mesh, end.z, Elastic::all(setting.problem.limits.size()),
                        margins, setting.control);
    CHECK(end.violation <= relaxed.t * 1.05);
  }
}

}  // namespace elastic_descent_test
