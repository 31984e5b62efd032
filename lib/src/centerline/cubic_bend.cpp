// With u = xi/d and w = 3 C d^2 = tan D the arc length is d Int sqrt(1 + w^2 u^4) du, an elliptic integral that Gauss
// points give to rounding. Backwards, xi/s is an analytic function of s^4, whose nearest singularity is where
// xi^4 = -1/(9 C^2): a Chebyshev series in it converges the faster the less the bend turns.

#include "glissade/centerline/cubic_bend.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "centerline/numerics/chebyshev_series.hpp"

#include <cmath>
#include <cstddef>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {
namespace {

/// Length of the curve eta' = w u^2 from 0 to u.
double arc_length(double w, double u) {
  const auto speed = [&](double at) { return std::sqrt(1.0 + w * w * at * at * at * at); };
  return boost::math::quadrature::gauss<double, 30>::integrate(speed, 0.0, u);
}

/// u at which the length is s, by Newton's method from below, where it converges from one side.
double along_of(double w, double s) {
  double u = s;
  for (int round = 0; round < 12; ++round) {
    const double step = (arc_length(w, u) - s) / std::sqrt(1.0 + w * w * u * u * u * u);
    u -= step;
    if (std::fabs(step) <= 1e-16 * u) break;
  }
  return u;
}

void require_usable(Angle turn, double end_radius) {
  if (!(turn.radians() > 0.0 && turn <= CubicBend::kMostTurn)) {
    throw InputError(
        {"",
         "a cubic bend that turns by " + texts_apart(turn, CubicBend::kMostTurn).first + " is out of range",
         "It turns by more than 0 and at most " + angle_text(CubicBend::kMostTurn) + ".",
         "several bends, of which each turns by less"});
  }
  if (!(end_radius > 0.0 && std::isfinite(end_radius))) {
    throw InputError(
        {"", "the radius of a cubic bend, " + exact_text(end_radius) + " m, is not positive and finite",
         "It is the radius where the bend ends.", "a radius above 0 m"});
  }
  if (!(end_radius >= kShortestWay && end_radius <= kLongestWay)) {
    throw InputError({"", "the radius of a cubic bend, " + exact_text(end_radius) + " m, is out of range",
                      "It is between " + rounded_text(kShortestWay, 3) + " m and " +
                          rounded_text(kLongestWay, 3) +
                          " m, so that nothing of the bend leaves the range of numbers.",
                      "a radius in metres"});
  }
}

}  // namespace

CubicBend::CubicBend(Angle turn, double end_radius) : turn_(turn), end_radius_(end_radius) {
  require_usable(turn, end_radius);
  const double cos_turn = math::cos(turn.radians());
  tan_turn_ = math::tan(turn.radians());
  reach_ = 2.0 * end_radius * math::sin(turn.radians()) * cos_turn * cos_turn;
  const double unit_length = arc_length(tan_turn_, 1.0);
  length_ = reach_ * unit_length;
  std::array<double, kTerms> values{};
  for (std::size_t j = 0; j < kTerms; ++j) {
    const double fourth_power = 0.5 * (1.0 + centerline::node_cosine<kTerms>(1, j));
    const double s = unit_length * std::sqrt(std::sqrt(fourth_power));
    values[j] = along_of(tan_turn_, s) / s;
  }
  along_per_length_ = centerline::chebyshev_series(values);
}

double CubicBend::smallest_radius() const {
  if (turn_ <= kGrowingTurn) return end_radius_;
  // kappa = 2 tan D u/(d (1 + w^2)^(3/2)) with w = tan D u^2 has its peak at w^2 = 1/5.
  const double u = std::sqrt(1.0 / (std::sqrt(5.0) * tan_turn_));
  return reach_ * 1.2 * std::sqrt(1.2) / (2.0 * tan_turn_ * u);
}

CubicBend::Place CubicBend::at(double s) const {
  const double fraction = s / length_;
  const double square = fraction * fraction;
  const double along = s * centerline::chebyshev_value(along_per_length_, 2.0 * square * square - 1.0);
  const double u = along / reach_;
  const double slope = tan_turn_ * u * u;
  const double stretch = 1.0 + slope * slope;
  return {along, along * slope / 3.0, math::atan(slope),
          2.0 * tan_turn_ * u / (reach_ * stretch * std::sqrt(stretch))};
}

}  // namespace glissade
