// Flight without air between a belt, a chute and a belt.

#include "glissade/trades/chute/ends.hpp"

#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>

namespace glissade {
namespace {

/// A flight from a point with a velocity, downwards positive, down by a height.
FeedFall flight(Vec2 velocity, double drop, double gravity) {
  const double down = std::sqrt(std::max(0.0, velocity.y * velocity.y + 2.0 * gravity * drop));
  FeedFall fall;
  fall.height = drop;
  fall.time = (down - velocity.y) / gravity;
  fall.reach = velocity.x * fall.time;
  fall.landing = {math::hypot(velocity.x, down), Angle::from_radians(math::atan2(down, velocity.x))};
  return fall;
}

}  // namespace

FeedFall fall_from_belt(const HeadPulley& pulley, double drop, double gravity) {
  const double hold = pulley.belt_speed * pulley.belt_speed / (gravity * pulley.radius);
  const double climb = pulley.belt_angle.radians();
  const double leaves_at = hold >= math::cos(climb) ? -climb : math::acos(hold);
  const Vec2 velocity{pulley.belt_speed * math::cos(leaves_at), pulley.belt_speed * math::sin(leaves_at)};
  FeedFall fall = flight(velocity, drop, gravity);
  fall.leaves_at = Angle::from_radians(leaves_at);
  fall.pulley = {-fall.reach - pulley.radius * math::sin(leaves_at),
                 drop - pulley.radius * math::cos(leaves_at)};
  return fall;
}

FeedFall fall_from_outlet(double outlet_speed, double drop, double gravity) {
  FeedFall fall = flight({0.0, outlet_speed}, drop, gravity);
  fall.landing.angle = Angle::from_degrees(90.0);
  return fall;
}

Impact impact_on(const Landing& landing, Angle slope_angle, Friction friction, double bulk_density) {
  Impact impact;
  impact.angle = landing.angle - slope_angle;
  impact.speed_ratio = speed_after(landing, slope_angle, friction) / landing.speed;
  const double into = landing.speed * math::sin(impact.angle.radians());
  impact.pressure = bulk_density * into * into;
  return impact;
}

Angle steepest_impact(double share, Friction friction) {
  const double phi = friction.angle().radians();
  return Angle::from_radians(math::acos(share * math::cos(phi)) - phi);
}

std::optional<Friction> most_friction_of_impact(double share, Angle angle) {
  const double left = math::cos(angle.radians()) - share;
  if (left < 0.0) return {};
  const double into = math::sin(angle.radians());
  // Of a stream that runs along the floor every friction leaves it: the last friction angle before 90 deg.
  const Angle last = Angle::from_radians(std::nextafter(kRightAngle, 0.0));
  if (!(into > 0.0)) return Friction::from_angle(last);
  return Friction::from_angle(std::min(Angle::from_radians(math::atan2(left, into)), last));
}

BeltLanding land_on_belt(double exit_speed, Angle slope_angle, const ReceivingBelt& belt, double bulk_density,
                         double gravity) {
  const double ahead = exit_speed * math::cos(slope_angle.radians());
  const double sinks = exit_speed * math::sin(slope_angle.radians());
  const double down = std::sqrt(std::max(0.0, sinks * sinks + 2.0 * gravity * belt.drop));
  const double turned = belt.direction.radians();
  const double climb = belt.slope.radians();
  BeltLanding landing;
  landing.speed = math::hypot(ahead, down);
  landing.time = (down - sinks) / gravity;
  landing.reach = ahead * landing.time;
  // A belt that runs on as the track does has no side: no minus in front of such zeros.
  landing.off_centre = 0.0 - landing.reach * math::sin(turned);
  landing.speed_along = ahead * math::cos(turned) * math::cos(climb) - down * math::sin(climb);
  landing.speed_into = down * math::cos(climb) + ahead * math::cos(turned) * math::sin(climb);
  landing.speed_across = 0.0 - ahead * math::sin(turned);
  landing.match = landing.speed_along / belt.speed;
  const double slip = math::hypot(belt.speed - landing.speed_along, landing.speed_across);
  landing.wear = belt.friction * bulk_density * landing.speed_into * landing.speed_into * slip;
  landing.wear_factor =
      landing.speed_into * landing.speed_into * slip / (landing.speed * landing.speed * landing.speed);
  return landing;
}

}  // namespace glissade
