// The transcription's gradients and Hessian against central differences carried out in the unknowns, and the
// limits' rows likewise. The differences are the test's; the product has none.

#include "optimize/rows.hpp"
#include "optimize/scaled_problem.hpp"
#include "optimize/transcription.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <random>

using namespace glissade;
using namespace glissade::fastest;

namespace {

struct Setup {
  ScaledProblem problem;
  Mesh mesh;
  Vector z;
};

Setup make_setup(double entry_speed) {
  Problem given;
  given.endpoints = {10.0, 5.0};
  given.body = {Friction::from_coefficient(0.2), entry_speed, 0.01};
  given.high_friction = Friction::from_coefficient(0.3);
  Limits& limits = given.limits;
  limits.lead_in = entry_speed > 0.0 ? 0.7 : 0.0;
  limits.lead_out = 1.1;
  limits.slope_angle.highest = 1.4;
  limits.smallest_valley_radius = 3.0;
  limits.smallest_crest_radius = 2.0;
  limits.highest_curvature_rate = 0.5;
  limits.highest_normal_load = 20.0;
  limits.highest_curvature_load = 10.0;
  limits.speed.highest = 8.0;
  limits.exit_speed.lowest = 2.0;
  limits.arc_length.highest = 14.0;
  limits.half_planes.push_back({{0.0, 1.0}, {-0.5, 1.0}, 0.1});
  limits.stay_above.push_back({{{1.0, 4.0}, {4.0, 5.0}, {7.0, 6.5}}, 0.2});
  limits.waypoints.push_back({5.0, 3.6});
  limits.exit_speed.highest = 9.0;
  Setup setup;
  setup.problem = scaled(given, {});
  setup.mesh.knots = {0.0, 0.1, 0.25, 0.5, 0.8, 1.0};
  setup.mesh.extra_breaks = {0.33};
  setup.mesh.lead_in = setup.problem.lead_in;
  setup.mesh.lead_out = setup.problem.lead_out;
  setup.mesh.core_length = 0.95;
  setup.mesh.entry_speed2 = setup.problem.entry_speed2;
  setup.z = {1.1, 0.3, 1.1, 0.9, 0.7, 1.2, 0.4, 0.9};
  return setup;
}

// Truncation h^2 f'''/6 and rounding 1e-16/h balance near here.
constexpr double kStep = 1e-5;
constexpr double kDifferenceError = 2e-8;

/// Greatest distance between a gradient and central differences of its function, over the gradient's size.
template <class Function>
double gradient_error(const Function& function, const Vector& z, const Vector& gradient) {
  double worst = 0.0;
  double size = 1.0;
  for (std::size_t j = 0; j < z.size(); ++j) {
    Vector above = z;
    Vector below = z;
    above[j] += kStep;
    below[j] -= kStep;
    // Richardson: fourth order from two second-order differences.
    const double wide = (function(above) - function(below)) / (2.0 * kStep);
    above[j] = z[j] + 2.0 * kStep;
    below[j] = z[j] - 2.0 * kStep;
    const double wider = (function(above) - function(below)) / (4.0 * kStep);
    worst = std::max(worst, std::fabs((4.0 * wide - wider) / 3.0 - gradient[j]));
    size = std::max(size, std::fabs(gradient[j]));
  }
  return worst / size;
}

}  // namespace

TEST_CASE("every row and the objective carry their exact gradient") {
  for (const double entry_speed : {0.0, 2.5}) {
    const Setup setup = make_setup(entry_speed);
    const Transcription track(setup.mesh);
    const Rows rows(setup.problem, track);
    const State state = rows.state(setup.z, true);
    CAPTURE(entry_speed);

    const auto objective = [&](const Vector& z) { return rows.objective(rows.state(z, false)); };
    CHECK(gradient_error(objective, setup.z, rows.objective_gradient(state)) < kDifferenceError);

    Vector value;
    Matrix jacobian;
    rows.equalities(state, value, jacobian);
    REQUIRE(value.size() == rows.equality_count());
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto equality = [&](const Vector& z) {
        Vector values;
        Matrix unused;
        rows.equalities(rows.state(z, true), values, unused);
        return values[i];
      };
      CAPTURE(i);
      CHECK(gradient_error(equality, setup.z, Vector(jacobian.row(i), jacobian.row(i) + setup.z.size())) <
            kDifferenceError);
    }

    const std::vector<Row> all = rows.candidates(state, 1e3);
    REQUIRE(all.size() > 300);
    for (const Row& row : all) {
      const auto inequality = [&](const Vector& z) { return rows.value(rows.state(z, false), row); };
      Vector gradient(setup.z.size());
      rows.gradient(state, row, gradient.data());
      CAPTURE(setup.problem.limits[row.limit].key, row.place, row.ride, row.foot);
      CHECK(gradient_error(inequality, setup.z, gradient) < kDifferenceError);
    }
  }
}

TEST_CASE("the Hessian of the Lagrangian is that of its gradient") {
  Setup setup = make_setup(2.5);
  setup.problem.drag = 0.0;  // drag enters the Hessian to first order only
  for (Ride& ride : setup.problem.rides) ride.drag = 0.0;
  setup.problem.speed_weight = 0.3;
  const Transcription track(setup.mesh);
  const Rows rows(setup.problem, track);
  const State state = rows.state(setup.z, true);
  // Finish and straight ends only: the waypoint's own second derivative is left to the quasi-Newton updates.
  Vector multipliers(rows.equality_count(), 0.0);
  multipliers[0] = 0.4;
  multipliers[1] = -0.7;
  const Matrix hessian = track.hessian(setup.z, state.shape, setup.problem.rides, state.flows,
                                       rows.weights(state, multipliers, {}, {}));
  for (std::size_t j = 0; j < setup.z.size(); ++j) {
    const auto slope = [&](const Vector& z) {
      const State at = rows.state(z, true);
      Vector value;
      Matrix jacobian;
      rows.equalities(at, value, jacobian);
      double sum = rows.objective_gradient(at)[j];
      for (std::size_t i = 0; i < value.size(); ++i) sum += multipliers[i] * jacobian(i, j);
      return sum;
    };
    CAPTURE(j);
    CHECK(gradient_error(slope, setup.z, Vector(hessian.row(j), hessian.row(j) + setup.z.size())) <
          10.0 * kDifferenceError);
  }
}
