// The cycloid by half the rolling angle, a. The ratio x/y = P(a)/sin(a), P as in phase.hpp, grows with a; its
// root is bracketed and found by TOMS 748, independently of the way that the case with friction is solved.
#include "glissade/centerline/cycloid.hpp"

#include "glissade/core/math.hpp"
#include "glissade/core/units.hpp"

#include "centerline/numerics/phase.hpp"
#include "centerline/optima/endpoint_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {

using namespace centerline;

namespace {

/// @return tan(a/2) where x/y = ratio
double finish_half_tangent(double ratio) {
  // With h = tan(a/2), x/y lies between the larger and the sum of 4 h/3 (steep limit) and pi h^2/4 (flat
  // limit).
  constexpr double kSlack = 1e-3;
  constexpr double kSteep = 4.0 / 3.0;
  constexpr double kFlat = std::numbers::pi / 4.0;
  const double low = 2.0 * ratio / (kSteep + std::sqrt(kSteep * kSteep + 4.0 * kFlat * ratio));
  const double high = std::min(ratio / kSteep, std::sqrt(ratio / kFlat));
  const auto excess = [ratio](double half_tangent) {
    const Phase half = phase_at(half_tangent);
    return math::log(half.first_integral / (half.sine * ratio));
  };
  constexpr int kAllBits = 53;
  std::uintmax_t steps = 100;
  const auto bracket =
      boost::math::tools::toms748_solve(excess, low * (1.0 - kSlack), high * (1.0 + kSlack),
                                        boost::math::tools::eps_tolerance<double>(kAllBits), steps);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

Cycloid::Cycloid(const Endpoints& endpoints) {
  require_falling(endpoints);
  const double run = std::fabs(endpoints.run);
  const double drop = std::max(endpoints.drop, kFlattest * run);
  if (as_vertical(run, drop)) {
    radius_ = std::numeric_limits<double>::infinity();
    length_ = endpoints.drop;
    return;
  }
  const double half_tangent = finish_half_tangent(run / drop);
  const Phase half = phase_at(half_tangent);
  radius_ = drop / (2.0 * half.sine * half.sine);
  length_ = 4.0 * radius_ * half.sine * half_tangent;  // 1 - cos a = sin a tan(a/2)
}

bool Cycloid::unbounded_curvature_at_start() const noexcept {
  return std::isfinite(radius_);
}

CenterlinePoint Cycloid::at(double s) const {
  require_on_track(s);
  if (!std::isfinite(radius_)) return {s, 0.0, s, kRightAngle, 0.0};
  if (s == 0.0) return {0.0, 0.0, 0.0, kRightAngle, std::numeric_limits<double>::infinity()};
  // On a flat one rounding makes nothing, or less, of what is left to the whole arch.
  const double rest = std::max(8.0 * radius_ - s, kFlattest * radius_);
  const Phase half = phase_at(std::sqrt(s / rest));
  return {s, 2.0 * radius_ * half.sine * half.first_integral, 2.0 * radius_ * half.sine * half.sine,
          kRightAngle - half.angle, 1.0 / (4.0 * radius_ * half.sine)};
}

}  // namespace glissade
