#include "coulomb_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace glissade::reference {
namespace {

using Real = boost::multiprecision::cpp_bin_float_quad;

/// The shape of a fastest track by t_1 = tan(exit slope angle).
struct Shape {
  Real mu, exit_slope, q;

  Shape(Real friction_coefficient, Real slope)
      : mu(std::move(friction_coefficient)), exit_slope(std::move(slope)) {
    q = sqrt(Real(1 - mu * mu + 2 * mu * exit_slope));
  }
};

/// x, y - mu x and T in units of C, and sqrt(C/g), from the start to where tan(slope angle) is some t.
struct Integrals {
  Real x, beyond, time;
};

/// Gauss nodes and weights on (0, 1).
struct Node {
  Real position, weight;
};

const std::vector<Node>& nodes() {
  static const std::vector<Node> kNodes = [] {
    using Gauss = boost::math::quadrature::gauss<boost::multiprecision::cpp_bin_float_50, 30>;
    std::vector<Node> all;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      const Real offset(Gauss::abscissa()[i] / 2);
      const Real weight(Gauss::weights()[i] / 2);
      all.push_back({0.5 + offset, weight});
      all.push_back({0.5 - offset, weight});
    }
    return all;
  }();
  return kNodes;
}

/// Where tau = t' - mu stands in the rational substitution |tau| = q (1 - h^2)/(2 h), 0 < h <= 1.
Real substitute(const Shape& shape, const Real& tau) {
  const Real size = abs(tau) / shape.q;
  return 1 / (size + sqrt(Real(1 + size * size)));
}

/// Adds the part of the integrals in which tau has the given sign and h runs from `low` to `high`.
void add_part(const Shape& shape, int sign, const Real& low, const Real& high, Integrals& sum) {
  const Real a = shape.mu - shape.exit_slope;
  for (const Node& node : nodes()) {
    const Real h = low + (high - low) * node.position;
    const Real tau = sign * shape.q * (1 - h * h) / (2 * h);
    const Real inverse = 1 / (tau * tau + shape.q * shape.q);
    const Real factor = 1 + 4 * shape.mu * (tau + a) * inverse;
    const Real width = (high - low) * node.weight * shape.q * (1 + h * h) / (2 * h * h);
    const Real time = width * inverse * factor;
    sum.time += time;
    sum.x += time * inverse;
    sum.beyond += time * inverse * tau;
  }
}

Integrals integrals_to(const Shape& shape, const Real& slope) {
  const Real tau = slope - shape.mu;
  const Real h = substitute(shape, tau);
  Integrals sum{0, 0, 0};
  if (tau >= 0) {
    add_part(shape, 1, 0, h, sum);
  } else {
    add_part(shape, 1, 0, 1, sum);
    add_part(shape, -1, h, 1, sum);
  }
  return sum;
}

/// @return ln of (y - mu x)/x at the finish
Real log_ratio(const Real& mu, const Real& exit_slope) {
  const Integrals finish = integrals_to(Shape(mu, exit_slope), exit_slope);
  return log(Real(finish.beyond / finish.x));
}

Real exit_slope_of(const CoulombSolution& solution) {
  const Real mu = solution.shape.friction_coefficient;
  const Real run = std::fabs(solution.endpoints.run);
  const Real target = log(Real((Real(solution.endpoints.drop) - mu * run) / run));
  const Real half_tangent = solution.shape.finish_phase_half_tangent;
  const Real q = solution.shape.q;
  Real first = mu + q * (1 - half_tangent * half_tangent) / (2 * half_tangent);
  Real scale = 1 + abs(first);
  if (mu > 0) scale = std::min(scale, Real(q * q / (2 * mu)));
  Real second = first + scale * 1e-9;
  Real at_first = log_ratio(mu, first) - target;
  for (int step = 0; step < 20; ++step) {
    const Real at_second = log_ratio(mu, second) - target;
    const Real next = second - at_second * (second - first) / (at_second - at_first);
    first = second;
    at_first = at_second;
    second = next;
    if (abs(at_first) < 1e-22) return second;
  }
  throw std::runtime_error("reference: no exit slope found");
}

double relative(double value, const Real& expected) {
  return static_cast<double>(abs(Real((value - expected) / expected)));
}

/// Absolute below one radian: an exit slope angle passes through zero.
double angle_error(double value, const Real& expected) {
  return static_cast<double>(abs(Real(value - expected)) / std::max(Real(1), Real(abs(expected))));
}

/// Arc length in units of C: the integrand of x times sqrt(1 + t^2), over panels that halve towards both
/// ends.
Real arc_length_to(const Shape& shape, const Real& slope) {
  const Real a = shape.mu - shape.exit_slope;
  const auto part = [&](int sign, const Real& low, const Real& high) {
    Real sum = 0;
    for (const Node& node : nodes()) {
      const Real h = low + (high - low) * node.position;
      const Real tau = sign * shape.q * (1 - h * h) / (2 * h);
      const Real t = tau + shape.mu;
      const Real inverse = 1 / (tau * tau + shape.q * shape.q);
      sum += (high - low) * node.weight * shape.q * (1 + h * h) / (2 * h * h) * sqrt(Real(1 + t * t)) *
             inverse * inverse * (1 + 4 * shape.mu * (tau + a) * inverse);
    }
    return sum;
  };
  const auto graded = [&](int sign, const Real& low, Real high) {
    Real sum = 0;
    while (high > low) {
      const bool last = high < shape.q * 1e-3 || high < 1e-12;
      const Real middle = last ? low : std::max(low, Real(high / 2));
      sum += part(sign, middle, high);
      high = middle;
    }
    return sum;
  };
  const Real tau = slope - shape.mu;
  const Real h = substitute(shape, tau);
  if (tau >= 0) return graded(1, 0, h);
  return graded(1, 0, 1) + graded(-1, h, 1);
}

}  // namespace

PreciseCurve::PreciseCurve(const CoulombSolution& solution) : solution_(solution) {
  const Real slope = exit_slope_of(solution);
  exit_slope_ = static_cast<double>(slope);
  exit_slope_remainder_ = static_cast<double>(Real(slope - exit_slope_));
}

SolutionErrors PreciseCurve::errors(const std::vector<double>& slope_angles) const {
  const Real exit_slope = Real(exit_slope_) + exit_slope_remainder_;
  const Real mu = solution_.shape.friction_coefficient;
  const Real gravity = solution_.gravity;
  const Real run = std::fabs(solution_.endpoints.run);
  const Real drop = solution_.endpoints.drop;
  const Shape shape(mu, exit_slope);
  const Integrals finish = integrals_to(shape, exit_slope);
  const Real scale = run / finish.x;
  const Real time_scale = sqrt(Real(scale / gravity));
  const Real speed_scale = sqrt(Real(scale * gravity));
  SolutionErrors errors;
  errors.travel_time = relative(solution_.travel_time, finish.time * time_scale);
  errors.exit_speed = relative(solution_.exit_speed, speed_scale / sqrt(Real(1 + exit_slope * exit_slope)));
  errors.exit_slope_angle = angle_error(solution_.exit_slope_angle.radians(), atan(exit_slope));
  errors.straight_time = relative(solution_.straight_time,
                                  sqrt(Real(2 * (run * run + drop * drop) / (gravity * (drop - mu * run)))));
  for (const double slope_angle : slope_angles) {
    const CoulombState state = solution_.at_slope_angle(Angle::from_radians(slope_angle));
    const Real slope = tan(Real(slope_angle));
    const Integrals there = integrals_to(shape, slope);
    const Real tau = slope - mu;
    errors.x = std::max(errors.x, relative(state.x, there.x * scale));
    errors.drop = std::max(errors.drop, relative(state.drop, (there.beyond + mu * there.x) * scale));
    errors.time = std::max(errors.time, relative(state.time, there.time * time_scale));
    errors.speed = std::max(errors.speed, relative(state.speed, speed_scale * sqrt(Real(1 + slope * slope)) /
                                                                    (tau * tau + shape.q * shape.q)));
  }
  return errors;
}

double PreciseCurve::position_error(const CoulombBrachistochrone& track, double slope_angle) const {
  const Real exit_slope = Real(exit_slope_) + exit_slope_remainder_;
  const Real mu = solution_.shape.friction_coefficient;
  const Shape shape(mu, exit_slope);
  const Real scale = Real(std::fabs(solution_.endpoints.run)) / integrals_to(shape, exit_slope).x;
  const Real slope = tan(Real(slope_angle));
  const Integrals there = integrals_to(shape, slope);
  const Real arc_length = scale * arc_length_to(shape, slope);
  const double nearest = std::min(static_cast<double>(arc_length), track.length());
  const Real beyond = arc_length - nearest;
  const CenterlinePoint point = track.at(nearest);
  const Real off_run = point.x + beyond * cos(Real(slope_angle)) - scale * there.x;
  const Real off_drop = point.drop + beyond * sin(Real(slope_angle)) - scale * (there.beyond + mu * there.x);
  return static_cast<double>(sqrt(Real(off_run * off_run + off_drop * off_drop))) / track.length();
}

}  // namespace glissade::reference
