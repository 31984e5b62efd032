// The fastest track of docs/theory.md in its phase form. With tan(zeta) = t, sin and cos of the phase phi:
//
//     t = mu + q cot(phi),  E = q^2/sin^2,  I1 = phi/q,  R = sqrt(sin^2 + mu^2)
//
// and at the finish, where E = 1 + t^2, q is a function of the phase alone: q sin = R + mu cos =: p. All
// integrals then collapse, C' = C/(2 q^3), P and Q as in phase.hpp:
//
//     H - mu L = C' sin (p + mu P)        L = C' sin (P + mu Q/p)
//     u_1^2 = 2 g (H - mu L) p/(p + mu P)       T = (u_1/g) [phi/sin + 2 mu (sin^2 + Q)/(3 p)]
//
// so that the two-point problem is one equation, ratio(phi) := (p + mu P)/(P + mu Q/p) = (H - mu L)/L,
// monotone in phi, with closed derivatives. No difference of large numbers is left in these forms.
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "centerline/numerics/phase.hpp"
#include "centerline/optima/coulomb_laws.hpp"
#include "centerline/optima/endpoint_rules.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace glissade {

using namespace centerline;

namespace {

/// A finish at a given phase: everything that depends on the phase and mu alone.
struct FinishPhase {
  double half_tangent = 0.0;  // tan(phi/2)
  Phase phase;
  double root = 0.0;  // R
  double p = 0.0;
  double drop = 0.0;  // p + mu P: drop beyond friction in units of C' sin
  double run = 0.0;   // P + mu Q/p: run in units of C' sin
};

FinishPhase finish_at(double mu, double half_tangent) {
  FinishPhase finish;
  finish.half_tangent = half_tangent;
  finish.phase = phase_at(half_tangent);
  const double sine = finish.phase.sine;
  const double cosine = finish.phase.cosine;
  finish.root = std::sqrt(sine * sine + mu * mu);
  finish.p =
      cosine >= 0.0 ? finish.root + mu * cosine : sine * sine * (1.0 + mu * mu) / (finish.root - mu * cosine);
  finish.drop = finish.p + mu * finish.phase.first_integral;
  finish.run = finish.phase.first_integral + mu * finish.phase.second_integral / finish.p;
  return finish;
}

/// First and second derivative of a function of ln tan(phi/2), where d(phi) = sin(phi) d(ln tan(phi/2)).
struct Slopes {
  double first = 0.0;
  double second = 0.0;
};

/// @return derivatives of ln ratio by ln tan(phi/2)
Slopes ratio_slopes(double mu, const FinishPhase& finish) {
  const auto& [half_tangent, phase, root, p, drop, run] = finish;
  const double cosine = phase.cosine;
  const double sine_squared = phase.sine * phase.sine;
  const double first = phase.first_integral;
  const double second = phase.second_integral;
  // P'' = P + 2 sin^2 cos and Q'' = Q + 6 sin^4; p' = p growth
  const double growth = cosine - mu / root;
  const double growth_slope = sine_squared * (mu * cosine / (root * root * root) - 1.0);
  const double first_slope = 2.0 * sine_squared - cosine * first;
  const double second_slope = 3.0 * sine_squared * first - cosine * second;
  const double drop_slope = p * growth + mu * first_slope;
  const double drop_bend = p * (growth * growth + growth_slope) + mu * (first + 2.0 * sine_squared * cosine);
  const double run_slope = first_slope + mu * (second_slope - second * growth) / p;
  const double second_bend = second + 6.0 * sine_squared * sine_squared;
  const double run_bend =
      first + 2.0 * sine_squared * cosine +
      mu * (second_bend - 2.0 * second_slope * growth + second * (growth * growth - growth_slope)) / p;
  const double drop_rate = drop_slope / drop;
  const double run_rate = run_slope / run;
  return {drop_rate - run_rate,
          drop_bend / drop - drop_rate * drop_rate - run_bend / run + run_rate * run_rate};
}

/// @return ratio at phi = pi/2
double middle_ratio(double mu) {
  const double p = std::sqrt(1.0 + mu * mu);
  return (p + mu * kRightAngle) / (kRightAngle + 2.0 * mu / p);
}

/// @return sin(phi) where ratio = 3 p/(2 sin^2): the steep limit, phi -> 0
double steep_sine(double mu, double ratio) {
  const double reach = 1.5 / ratio;
  return std::sqrt(reach * (2.0 * mu + reach));
}

/// Half tangent in the flat limit, phi -> pi, where P sin -> pi, Q sin -> 3 pi: the equation becomes
/// (sin p - (ratio - mu) pi) p = 3 pi ratio mu with sin^2 = p (p + 2 mu)/(1 + mu^2), convex in p.
double flat_half_tangent(double mu, double ratio) {
  const double norm = std::sqrt(1.0 + mu * mu);
  const double linear = (ratio - mu) * std::numbers::pi;
  const double constant = 3.0 * std::numbers::pi * ratio * mu;
  double p = math::cbrt(constant * norm) + std::sqrt(std::max(linear, 0.0) * norm);  // beyond the root
  if (ratio < mu) p = std::min(p, 3.0 * ratio * mu / (mu - ratio));
  for (int step = 0; step < 4; ++step) {
    const double sine = std::sqrt(p * (p + 2.0 * mu)) / norm;
    const double sine_slope = (p + mu) / (norm * norm * sine);
    const double value = (sine * p - linear) * p - constant;
    p -= value / (2.0 * sine * p + sine_slope * p * p - linear);
  }
  return 2.0 * norm / std::sqrt(p * (p + 2.0 * mu));
}

/// @return tan(phi/2) within a factor of 1.5 of the root
double first_guess(double mu, double ratio) {
  const double middle = middle_ratio(mu);
  if (ratio < middle) return flat_half_tangent(mu, ratio);
  const double sine = steep_sine(mu, ratio);
  const double weight = middle / ratio;  // 1 at phi = pi/2, where the half tangent is 1
  return (1.0 - weight) * sine / 2.0 + weight * sine / steep_sine(mu, middle);
}

/// Halley's iteration on ln ratio over ln tan(phi/2), kept within a bracket.
/// @return the finish whose ratio is the given one
FinishPhase solve_finish(double mu, double ratio) {
  constexpr double kCubicallyConverged = 1e-6;  // its cube is below rounding
  constexpr int kMostSteps = 200;
  double below = 0.0;
  double above = std::numeric_limits<double>::infinity();
  double half_tangent = first_guess(mu, ratio);
  for (int step = 0; step < kMostSteps; ++step) {
    const FinishPhase finish = finish_at(mu, half_tangent);
    const double excess = math::log(finish.drop / (finish.run * ratio));
    (excess > 0.0 ? below : above) = half_tangent;
    const Slopes slopes = ratio_slopes(mu, finish);
    const double halley =
        -2.0 * excess * slopes.first / (2.0 * slopes.first * slopes.first - excess * slopes.second);
    const double next = half_tangent * math::exp(std::clamp(halley, -1.0, 1.0));
    if (std::fabs(halley) < kCubicallyConverged) return finish_at(mu, next);
    half_tangent = next > below && next < above ? next : std::sqrt(below * above);
  }
  throw InternalError({"",
                       "fastest track: no phase found for friction coefficient " + exact_text(mu) +
                           " and (drop - mu run)/run = " + exact_text(ratio),
                       "The iteration is bracketed and cannot fail.", ""});
}

double exit_slope(double mu, const FinishPhase& finish) {
  const double cosine = finish.phase.cosine;
  const double sine = finish.phase.sine;
  if (cosine >= 0.0) return math::atan2(mu + cosine * finish.root, sine * sine);
  return math::atan((mu - cosine) * (mu + cosine) / (mu - cosine * finish.root));
}

CoulombSolution free_fall(const Endpoints& endpoints, double gravity) {
  CoulombSolution solution;
  solution.exit_speed = std::sqrt(2.0 * gravity * endpoints.drop);
  solution.travel_time = std::sqrt(2.0 * endpoints.drop / gravity);
  solution.straight_time = solution.travel_time;
  solution.exit_slope_angle = Angle::from_radians(kRightAngle);
  solution.gravity = gravity;
  solution.endpoints = endpoints;
  return solution;
}

}  // namespace

CoulombSolution solve_coulomb_brachistochrone(const Endpoints& endpoints, Friction friction, double gravity) {
  require_reachable_from_rest(endpoints, friction);
  require_gravity(gravity);
  const double mu = friction.coefficient();
  const double run = std::fabs(endpoints.run);
  const double drop = std::max(drop_beyond_friction(endpoints, friction), kFlattest * run);
  if (as_vertical(run, drop)) return free_fall(endpoints, gravity);
  const double ratio = drop / run;

  CoulombSolution solution;
  const FinishPhase finish = solve_finish(mu, ratio);
  const double sine = finish.phase.sine;
  solution.shape.finish_phase_half_tangent = finish.half_tangent;
  solution.shape.friction_coefficient = mu;
  solution.shape.q = finish.p / sine;
  solution.shape.scale = drop / (finish.drop * sine);
  solution.exit_speed = std::sqrt(2.0 * gravity * drop * (finish.p / finish.drop));
  solution.travel_time = solution.exit_speed / gravity *
                         (finish.phase.angle / sine +
                          2.0 * mu * (sine * sine + finish.phase.second_integral) / (3.0 * finish.p));
  solution.exit_slope_angle = Angle::from_radians(exit_slope(mu, finish));
  solution.straight_time = math::hypot(run, endpoints.drop) * std::sqrt(2.0 / (gravity * drop));
  solution.gravity = gravity;
  solution.endpoints = endpoints;
  return solution;
}

CoulombState CoulombSolution::at_slope_angle(Angle slope_angle) const {
  return coulomb_state(*this, half_tangent_at_slope_angle(*this, slope_angle.radians()));
}

}  // namespace glissade
