#include "glissade/motion/stall_friction.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/units.hpp"

#include <algorithm>

namespace glissade {
namespace {

constexpr Angle kSteepest = Angle::from_degrees(89.9);

/// The body with that friction, changes along the track shifted by the same angle as far as there is friction.
Body with_friction(Body body, Angle angle) {
  const double shift = angle.radians() - body.friction.angle().radians();
  body.friction = Friction::from_angle(angle);
  for (FrictionChange& change : body.friction_changes) {
    const double own = change.friction.angle().radians();
    const double shifted = std::clamp(own + shift, 0.0, std::max(own, kSteepest.radians()));
    change.friction = Friction::from_angle(Angle::from_radians(shifted));
  }
  return body;
}

enum class Outcome {
  rides,   ///< it does not get stuck
  sticks,  ///< it stalls or chokes
  misses   ///< it does not get onto the track
};

Outcome outcome_of(const CenterlinePtr& centerline, const Body& body, Angle angle, double gravity) {
  const Body rubbed = with_friction(body, angle);
  try {
    const Motion motion(centerline, rubbed, gravity);
    if (!lands(motion) || (rubbed.approach && rubbed.approach->falls_away(rubbed))) return Outcome::misses;
    // A stream that slows down chokes before it stands.
    const bool chokes = motion.law_end() && motion.law_end()->what != "valley_radius_m";
    return motion.stall() || chokes ? Outcome::sticks : Outcome::rides;
  } catch (const ConvergenceError&) {
    return Outcome::rides;  // free flight along a track at an absurd friction: it feels none
  }
}

}  // namespace

bool stalls_at(const CenterlinePtr& centerline, const Body& body, Angle angle, double gravity) {
  return outcome_of(centerline, body, angle, gravity) == Outcome::sticks;
}

std::optional<Angle> stall_friction_angle(const CenterlinePtr& centerline, const Body& body, double gravity) {
  const auto outcome = [&](double radians) {
    return outcome_of(centerline, body, Angle::from_radians(radians), gravity);
  };
  if (outcome(0.0) == Outcome::sticks) return Angle{};
  // From the body's own friction, the one that people ask about, towards the steepest: at absurd frictions a ride
  // that touches the track without load (N = 0) cannot be told from one that leaves it.
  double clear = 0.0;
  double stuck = body.friction.angle().radians();
  const Outcome own = outcome(stuck);
  Outcome beyond = own;  // at `stuck`
  // What comes from a hood misses the track beyond some friction: it has got stuck before, or never does. Where it already
  // misses, or gets stuck, what is below may miss as well, too fast for the start.
  const auto is_clear = [&](Outcome found) {
    return found == Outcome::rides || (own != Outcome::rides && found == Outcome::misses);
  };
  while (is_clear(beyond)) {
    if (stuck >= kSteepest.radians()) return {};
    clear = stuck;
    stuck = std::min(0.5 * (stuck + kRightAngle), kSteepest.radians());
    beyond = outcome(stuck);
  }
  while (stuck - clear > kStallFrictionAccuracy) {
    const double tried = 0.5 * (clear + stuck);
    const Outcome found = outcome(tried);
    (is_clear(found) ? clear : stuck) = tried;
    if (!is_clear(found)) beyond = found;
  }
  if (beyond == Outcome::misses) return {};
  return Angle::from_radians(clear);
}

}  // namespace glissade
