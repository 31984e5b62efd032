#include "glissade/motion/stall_friction.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"

#include <algorithm>

namespace glissade {
namespace {

constexpr Angle kSteepest = Angle::from_degrees(89.9);

/// The body with that friction, changes along the track shifted by the same angle.
Body with_friction(Body body, Angle angle) {
  const double shift = angle.radians() - body.friction.angle().radians();
  body.friction = Friction::from_angle(angle);
  for (FrictionChange& change : body.friction_changes) {
    const double shifted = std::clamp(change.friction.angle().radians() + shift, 0.0, kSteepest.radians());
    change.friction = Friction::from_angle(Angle::from_radians(shifted));
  }
  return body;
}

}  // namespace

bool stalls_at(const CenterlinePtr& centerline, const Body& body, Angle angle, double gravity) {
  try {
    const Motion motion(centerline, with_friction(body, angle), gravity);
    // A stream that slows down chokes before it stands.
    const bool chokes = motion.law_end() && motion.law_end()->what != "valley_radius_m";
    return motion.stall().has_value() || chokes;
  } catch (const ConvergenceError&) {
    return false;  // free flight along a track at an absurd friction: it feels none
  }
}

std::optional<Angle> stall_friction_angle(const CenterlinePtr& centerline, const Body& body, double gravity) {
  const auto stalls = [&](Angle angle) { return stalls_at(centerline, body, angle, gravity); };
  if (stalls(Angle{})) return Angle{};
  // From the body's own friction, the one that people ask about, towards the steepest: at absurd frictions a ride
  // that touches the track without load (N = 0) cannot be told from one that leaves it.
  double clear = 0.0;
  double stuck = body.friction.angle().radians();
  while (!stalls(Angle::from_radians(stuck))) {
    if (stuck >= kSteepest.radians()) return {};
    clear = stuck;
    stuck = std::min(0.5 * (stuck + kRightAngle), kSteepest.radians());
  }
  while (stuck - clear > kStallFrictionAccuracy) {
    const double tried = 0.5 * (clear + stuck);
    (stalls(Angle::from_radians(tried)) ? stuck : clear) = tried;
  }
  return Angle::from_radians(clear);
}

}  // namespace glissade
