#include "glissade/motion/stall_friction.hpp"

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

std::optional<Angle> stall_friction_angle(const CenterlinePtr& centerline, const Body& body, double gravity) {
  const auto stalls = [&](Angle angle) {
    return Motion(centerline, with_friction(body, angle), gravity).stall().has_value();
  };
  if (stalls(Angle{})) return Angle{};
  if (!stalls(kSteepest)) return {};
  double clear = 0.0;
  double stuck = kSteepest.radians();
  // The body's own friction is the one that people ask about: often it halves the range at once.
  double tried = body.friction.angle().radians();
  while (stuck - clear > kStallFrictionAccuracy) {
    if (!(tried > clear && tried < stuck)) tried = 0.5 * (clear + stuck);
    (stalls(Angle::from_radians(tried)) ? stuck : clear) = tried;
    tried = 0.5 * (clear + stuck);
  }
  return Angle::from_radians(clear);
}

}  // namespace glissade
