// Equations of arXiv 2502.00368 as printed, except: the constant c of eq. 17 and the absolute value of
// eq. 19.
#include "glissade/centerline/pudasaini.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade::pudasaini {
namespace {

using Quadrature = boost::math::quadrature::gauss<double, 30>;

/// Panels between two breaks of a track in eq. 7 and 9; the first starts with s = r^2.
constexpr int kPanels = 8;

/// Integral over [low, high], low and high within the same smooth piece of the track.
template <class Integrand>
double integral(const Integrand& integrand, double low, double high) {
  double sum = 0.0;
  const double width = (high - low) / kPanels;
  for (int panel = 0; panel < kPanels; ++panel) {
    sum += Quadrature::integrate(integrand, low + panel * width, low + (panel + 1) * width);
  }
  return sum;
}

/// Integral over [0, s] of an integrand that is smooth between the track's breaks and may grow like
/// s^(-1/2) at the start.
template <class Integrand>
double integral_from_start(const Centerline& track, const Integrand& integrand, double s) {
  double sum = 0.0;
  const std::vector<double> breaks = track.breaks();
  for (std::size_t piece = 1; piece < breaks.size() && breaks[piece - 1] < s; ++piece) {
    const double end = std::min(s, breaks[piece]);
    if (piece > 1) {
      sum += integral(integrand, breaks[piece - 1], end);
      continue;
    }
    const auto in_root = [&](double root) { return 2.0 * root * integrand(std::min(end, root * root)); };
    sum += integral(in_root, 0.0, std::sqrt(end));
  }
  return sum;
}

}  // namespace

double scaled_gravity(const Setting& setting) {
  return setting.gravity / setting.p;
}

double lambda(const Setting& setting) {
  if (setting.friction.coefficient() == 0.0) {
    throw InputError(Issue{"", "friction_coefficient: 0 leaves lambda = g/(P mu) undefined", "",
                           "a friction coefficient above 0"});
  }
  return scaled_gravity(setting) / setting.friction.coefficient();
}

double speed_from_rest(const Centerline& track, double s, Friction friction, double gravity) {
  const double mu = friction.coefficient();
  const double start = track.slope_angle(0.0);
  const auto drive = [&](double station) {
    const double zeta = track.slope_angle(station);
    return math::exp(-2.0 * mu * (zeta - start)) * (math::sin(zeta) - mu * math::cos(zeta));
  };
  const double square = 2.0 * gravity * math::exp(2.0 * mu * (track.slope_angle(s) - start)) *
                        integral_from_start(track, drive, s);
  if (square >= 0.0) return std::sqrt(square);
  throw InfeasibleError(Issue{"", "a body from rest stalls before s = " + length_text(s), "", ""});
}

double travel_time_from_rest(const Centerline& track, Friction friction, double gravity) {
  const auto slowness = [&](double s) { return 1.0 / speed_from_rest(track, s, friction, gravity); };
  return integral_from_start(track, slowness, track.length());
}

double slope_angle_rate(Angle slope_angle, const Setting& setting) {
  return -lambda(setting) * (math::sin(slope_angle.radians()) -
                             setting.friction.coefficient() * math::cos(slope_angle.radians()));
}

double offset(double x, double y, Angle slope_angle, const Setting& setting) {
  return slope_angle.radians() - lambda(setting) * (setting.friction.coefficient() * x - y);
}

double slope(double x, double y, double offset, const Setting& setting) {
  return math::tan(lambda(setting) * (setting.friction.coefficient() * x - y) + offset);
}

double slope_derivative(double slope, const Setting& setting) {
  return lambda(setting) * (1.0 + slope * slope) * (setting.friction.coefficient() - slope);
}

double implicit_constant(double x, double y, double offset, const Setting& setting) {
  const double mu = setting.friction.coefficient();
  const double angle = lambda(setting) * (mu * x - y) + offset;
  const double argument = mu * math::cos(angle) - math::sin(angle);
  if (argument == 0.0) {
    throw InputError(
        Issue{"", "the implicit solution has no logarithm where the slope equals mu = " + exact_text(mu), "",
              "a track that is not straight"});
  }
  return (mu * angle - math::log(std::abs(argument))) / (1.0 + mu * mu) - lambda(setting) * x;
}

double sag(const ConstantSpeedCurve& curve) {
  const double run = std::abs(curve.endpoints().run);
  const double drop = curve.endpoints().drop;
  const double chord_angle = math::atan2(drop, run);
  if (curve.entry_slope_angle() == curve.exit_slope_angle()) return 0.0;
  // Farthest from the chord where the track is parallel to it.
  const CenterlinePoint farthest = curve.at(curve.arc_length_at_slope(Angle::from_radians(chord_angle)));
  return std::abs(farthest.drop * math::cos(chord_angle) - farthest.x * math::sin(chord_angle));
}

std::vector<ConstantSpeedCurve> figure_one(Endpoints endpoints, double p, double gravity) {
  std::vector<ConstantSpeedCurve> curves;
  curves.reserve(kFigureOneFrictionAnglesDeg.size());
  for (const double angle : kFigureOneFrictionAnglesDeg) {
    curves.emplace_back(endpoints, Friction::from_angle(Angle::from_degrees(angle)), gravity, p);
  }
  return curves;
}

}  // namespace glissade::pudasaini
