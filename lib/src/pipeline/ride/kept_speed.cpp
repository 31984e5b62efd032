// Which bodies keep the speed of a constant-speed curve (docs/theory.md, (C2)): those that nothing but the friction resists
// for which the curve was made.

#include "glissade/pipeline/solve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace glissade {
namespace {

/// Whether a stream of that speed rubs all along as the curve has it.
bool rubs_alike(const ConstantSpeedCurve& curve, const Body& body) {
  constexpr double kRounding = 1e-12;  // rounding: of the square of a speed and of what follows from it
  const Law& law = *body.law;
  if (law.side() != 1.0 || !body.friction_changes.empty()) return false;
  std::vector<double> places = law.breaks();
  places.insert(places.end(), {0.0, curve.length()});
  return std::all_of(places.begin(), places.end(), [&](double place) {
    const double s = std::min(place, curve.length());
    const double rubs = law.resistance(s, curve.p()).factor * body.friction.coefficient();
    return std::fabs(rubs - curve.friction().coefficient()) <= kRounding * rubs;
  });
}

}  // namespace

std::optional<double> kept_speed(const ConstantSpeedCurve& curve, const Body& body) {
  if (body.drag_per_metre > 0.0 || !curve.holds_body()) return {};
  const bool stream = body.law && body.law->depends_on_speed();
  const bool keeps =
      stream ? rubs_alike(curve, body) : is_sliding_point(body) && body.friction == curve.friction();
  if (!keeps) return {};
  return curve.constant_speed();
}

}  // namespace glissade
