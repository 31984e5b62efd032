// The curve of the header by h = tan(a/2), P as in phase.hpp:
//
//     x = 2 A sin(a) [P + mu sin(a)]      y - mu x = 4 A sin(a) (h + mu)(1 - mu h)/(1 + h^2)
//     (y - mu x)/x falls from infinity at h = 0 to 0 at h = 1/mu, that is a = pi - 2 delta.
#include "glissade/centerline/no_curvature_load.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include "centerline/numerics/phase.hpp"
#include "centerline/optima/endpoint_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {

using namespace centerline;

namespace {

/// @return tan(a/2) where (y - mu x)/x = ratio
double finish_half_tangent(double mu, double ratio) {
  const auto excess = [mu, ratio](double half_tangent) {
    const Phase half = phase_at(half_tangent);
    const double drop =
        2.0 * (half_tangent + mu) * (1.0 - mu * half_tangent) / (1.0 + half_tangent * half_tangent);
    return drop - ratio * (half.first_integral + mu * half.sine);
  };
  double low = 1.0;
  while (excess(low) <= 0.0) low *= 0.25;
  double high = low;
  while (excess(high) >= 0.0) high = mu > 0.0 ? std::min(4.0 * high, 1.0 / mu) : 4.0 * high;
  constexpr int kAllBits = 53;
  std::uintmax_t steps = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      excess, low, high, boost::math::tools::eps_tolerance<double>(kAllBits), steps);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

NoCurvatureLoadCurve::NoCurvatureLoadCurve(const Endpoints& endpoints, Friction friction)
    : mu_(friction.coefficient()) {
  require_reachable_from_rest(endpoints, friction);
  const double run = std::fabs(endpoints.run);
  const double drop = std::max(drop_beyond_friction(endpoints, friction), kFlattest * run);
  if (as_vertical(run, drop)) {
    scale_ = std::numeric_limits<double>::infinity();
    length_ = endpoints.drop;
    return;
  }
  finish_half_tangent_ = finish_half_tangent(mu_, drop / run);
  const Phase half = phase_at(finish_half_tangent_);
  scale_ = run / (2.0 * half.sine * (half.first_integral + mu_ * half.sine));
  length_ = 4.0 * scale_ * half.sine * (finish_half_tangent_ + mu_);  // 1 - cos a = sin a tan(a/2)
}

double NoCurvatureLoadCurve::travel_time_without_curvature_load(double gravity) const {
  require_gravity(gravity);
  if (!std::isfinite(scale_)) return std::sqrt(2.0 * length_ / gravity);
  // cos(a + delta)/cos(delta) = cos a - mu sin a; the arccosine by its half angle
  const Phase half = phase_at(finish_half_tangent_);
  const double fall = half.sine * (finish_half_tangent_ + mu_);        // 1 - cosine
  const double rest = half.sine * (1.0 / finish_half_tangent_ - mu_);  // 1 + cosine
  return 4.0 * std::sqrt(scale_ / gravity) * math::atan2(std::sqrt(fall), std::sqrt(rest));
}

bool NoCurvatureLoadCurve::unbounded_curvature_at_start() const noexcept {
  return std::isfinite(scale_) && mu_ == 0.0;
}

CenterlinePoint NoCurvatureLoadCurve::at(double s) const {
  require_on_track(s);
  if (!std::isfinite(scale_)) return {s, 0.0, s, kRightAngle, 0.0};
  if (s == 0.0) return {0.0, 0.0, 0.0, kRightAngle, 1.0 / (4.0 * scale_ * mu_)};
  const double part = s / (4.0 * scale_);  // 1 - cos a + mu sin a, a quadratic in tan(a/2)
  const double half_tangent = part / (mu_ + std::sqrt(std::max(0.0, mu_ * mu_ + part * (2.0 - part))));
  const Phase half = phase_at(std::min(half_tangent, finish_half_tangent_));
  return {s, 2.0 * scale_ * half.sine * (half.first_integral + mu_ * half.sine),
          2.0 * scale_ * (half.sine * half.sine + mu_ * (half.angle + half.sine * half.cosine)),
          kRightAngle - half.angle, 1.0 / (4.0 * scale_ * (half.sine + mu_ * half.cosine))};
}

}  // namespace glissade
