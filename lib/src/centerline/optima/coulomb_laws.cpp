// The fastest track between start and finish, in the phase form of coulomb_solution.cpp. With k = cot(phi_1),
// W = sqrt(sin^2 + (mu sin + q cos)^2) = sin/cos(zeta), D = cos - k sin = sin(phi_1 - phi)/sin(phi_1) and
// B = 1 + 4 mu sin D/q:
//
//     x        = C' [P sin + 2 mu (sin^4 - 4 k Int sin^4)/q]
//     y - mu x = C' [q sin^2 + mu sin (P + 2 sin^2 D)]
//     T        = sqrt(2 C' q/g) [phi + 2 mu (sin^2 - k P sin)/q]      u = sqrt(2 g C'/q) W sin
//     ds/dphi  = 2 C' W B sin       d zeta/dphi = -q/W^2
#include "centerline/optima/coulomb_laws.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "centerline/numerics/phase.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace glissade::centerline {
namespace {

double finish_cotangent(const CoulombShape& shape) {
  const double half_tangent = shape.finish_phase_half_tangent;
  return (1.0 - half_tangent) * (1.0 + half_tangent) / (2.0 * half_tangent);
}

/// @return Int sin^4 / sin; the two forms are equal, each loses no digits where it is used
double fourth_power_integral(const Phase& phase) {
  const double sine_squared = phase.sine * phase.sine;
  if (phase.angle < kSeriesPhase) {
    return (2.0 * sine_squared * sine_squared - phase.second_integral) / (8.0 * phase.cosine);
  }
  return (3.0 * phase.first_integral - 2.0 * sine_squared * phase.cosine) / 8.0;
}

/// @return W = sin(phi)/cos(zeta)
double stretch(const CoulombShape& shape, double sine, double cosine) {
  const double rise = shape.friction_coefficient * sine + shape.q * cosine;
  return std::sqrt(sine * sine + rise * rise);
}

/// @return D, which vanishes at the finish
double phase_left(const CoulombShape& shape, double half_tangent) {
  const double finish = shape.finish_phase_half_tangent;
  return (1.0 - half_tangent / finish) * (1.0 + half_tangent * finish) / (1.0 + half_tangent * half_tangent);
}

/// @return B
double curvature_load_factor(const CoulombShape& shape, double sine, double left) {
  return 1.0 + 4.0 * shape.friction_coefficient * sine * left / shape.q;
}

struct Path {
  double stretch = 0.0;    // W
  double arc_slope = 0.0;  // ds/dphi
};

Path path_at(const CoulombShape& shape, double half_tangent) {
  const double norm = 1.0 / (1.0 + half_tangent * half_tangent);
  const double sine = 2.0 * half_tangent * norm;
  const double cosine = (1.0 - half_tangent) * (1.0 + half_tangent) * norm;
  const double width = stretch(shape, sine, cosine);
  const double load = curvature_load_factor(shape, sine, phase_left(shape, half_tangent));
  return {width, 2.0 * shape.scale * sine * width * load};
}

}  // namespace

double half_tangent_at_slope_angle(const CoulombSolution& solution, double slope_angle) {
  const CoulombShape& shape = solution.shape;
  if (shape.scale == 0.0) {
    throw InputError({"", "slope angle: a vertical track has the same slope everywhere",
                      "Run " + exact_text(solution.endpoints.run) + " m leaves nothing but free fall.",
                      "arc length instead of slope angle"});
  }
  if (!(slope_angle >= solution.exit_slope_angle.radians() - kSlopeAngleRounding &&
        slope_angle <= kRightAngle)) {
    throw InputError({"", "slope angle: " + exact_text(slope_angle) + " rad does not occur on this track",
                      "It falls from " + exact_text(kRightAngle) + " rad at the start to " +
                          exact_text(solution.exit_slope_angle.radians()) + " rad at the finish.",
                      ""});
  }
  if (slope_angle == kRightAngle) return 0.0;
  const double sine = shape.q * math::cos(slope_angle);
  const double cosine = math::sin(slope_angle) - shape.friction_coefficient * math::cos(slope_angle);
  const double norm = math::hypot(sine, cosine);
  const double half_tangent = cosine > 0.0 ? sine / (norm + cosine) : (norm - cosine) / sine;
  return std::min(half_tangent, shape.finish_phase_half_tangent);
}

double coulomb_slope_angle(const CoulombShape& shape, double half_tangent) {
  const double sine = 2.0 * half_tangent;
  const double cosine = (1.0 - half_tangent) * (1.0 + half_tangent);
  return math::atan2(shape.friction_coefficient * sine + shape.q * cosine, sine);
}

double arc_length_slope(const CoulombShape& shape, double half_tangent) {
  return path_at(shape, half_tangent).arc_slope;
}

double coulomb_curvature(const CoulombShape& shape, double half_tangent) {
  if (half_tangent == 0.0) return std::numeric_limits<double>::infinity();
  const Path path = path_at(shape, half_tangent);
  return shape.q / (path.stretch * path.stretch) / path.arc_slope;
}

CoulombState coulomb_state(const CoulombSolution& solution, double half_tangent) {
  const CoulombShape& shape = solution.shape;
  const double mu = shape.friction_coefficient;
  const double q = shape.q;
  if (half_tangent == 0.0) {
    return {kRightAngle, 0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0, 0.0};
  }
  const Phase phase = phase_at(half_tangent);
  const double sine = phase.sine;
  const double cotangent = finish_cotangent(shape);
  const double width = stretch(shape, sine, phase.cosine);
  const double size = shape.scale * sine;
  const double left = phase_left(shape, half_tangent);
  CoulombState state;
  state.slope_angle = coulomb_slope_angle(shape, half_tangent);
  state.x = size * (phase.first_integral +
                    2.0 * mu * (sine * sine * sine - 4.0 * cotangent * fourth_power_integral(phase)) / q);
  state.drop = size * (q * sine + mu * (phase.first_integral + 2.0 * sine * sine * left)) + mu * state.x;
  state.curvature = coulomb_curvature(shape, half_tangent);
  state.speed = std::sqrt(2.0 * solution.gravity * shape.scale / q) * sine * width;
  state.time = std::sqrt(2.0 * shape.scale * q / solution.gravity) *
               (phase.angle + 2.0 * mu * sine * (sine - cotangent * phase.first_integral) / q);
  return state;
}

}  // namespace glissade::centerline
