#pragma once

#include "glissade/core/units.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/motion/motion.hpp"

#include <optional>

namespace glissade {

/// The head pulley of a belt that feeds a chute.
struct HeadPulley {
  double belt_speed = 0.0;  ///< [m/s]; > 0
  double radius = 0.0;      ///< of the pulley with its belt [m]; > 0
  Angle belt_angle;         ///< of the belt before it, upwards where positive
};

/// How a feed comes down on the start of a track, in the plane of the track.
struct FeedFall {
  Landing landing;      ///< on the start
  double reach = 0.0;   ///< horizontal way through the air [m]
  double time = 0.0;    ///< through the air [s]
  double height = 0.0;  ///< fallen [m]
  /// Of a belt: how far round the pulley past its top the stream leaves it; minus the belt's angle where it
  /// leaves at once because it is faster than the pulley can hold it.
  Angle leaves_at;
  Vec2 pulley;  ///< of a belt: its centre seen from the start of the track, run and height above it [m]
};

/// @param drop  from where the stream leaves the pulley down to the start [m]; > 0
/// A stream stays on the pulley until cos(psi) = v^2/(g R), psi from the vertical; where v^2/(g R) >= cos(belt
/// angle) it leaves at once, in the belt's direction. From there it flies without air.
[[nodiscard]] FeedFall fall_from_belt(const HeadPulley& pulley, double drop, double gravity);

/// @param outlet_speed  straight down [m/s]; >= 0
/// @param drop          from the outlet down to the start [m]; >= 0, one of the two > 0
[[nodiscard]] FeedFall fall_from_outlet(double outlet_speed, double drop, double gravity);

/// What the impact of a feed does (docs/chutes.md, feed).
struct Impact {
  Angle angle;               ///< theta, between the way of the stream and the floor
  double speed_ratio = 0.0;  ///< V2/V1 = cos(theta + phi)/cos(phi); not positive: it stands there
  double pressure = 0.0;     ///< rho V1^2 sin^2(theta) [Pa]
};

[[nodiscard]] Impact impact_on(const Landing& landing, Angle slope_angle, Friction friction,
                               double bulk_density);

/// The share of its speed that practice wants an impact to leave: rule `chute.4.impact-ratio`.
inline constexpr double kSpeedToKeep =
    0.3;  // theory: Stuart-Dick and Royal 1991; practice of chute designers
/// @param share  of the speed, (0, 1]
/// @return the greatest theta at which an impact leaves it: cos(theta + phi) = share cos(phi)
[[nodiscard]] Angle steepest_impact(double share, Friction friction);
/// @param share  of the speed, (0, 1]
/// @param angle  theta
/// @return the most friction with which an impact leaves it, that of the last friction angle below 90 deg where every one
///         does (theta = 0); none if not even one without friction does
[[nodiscard]] std::optional<Friction> most_friction_of_impact(double share, Angle angle);

/// A belt that takes a stream away.
struct ReceivingBelt {
  double speed = 0.0;     ///< v_b [m/s]; > 0
  Angle direction;        ///< seen from above, from the track's own to the left
  Angle slope;            ///< it climbs where positive
  double drop = 0.0;      ///< from the finish of the track down to the belt [m]; >= 0
  double friction = 0.5;  ///< mu_b between stream and belt
};

/// So little of its speed away from a belt is rounding of one that is laid down along it.
inline constexpr double kBeltLandingRounding = 1e-9;  // rounding: of angles in degrees and back

/// How a stream lands on a belt (docs/chutes.md, discharge): what it does where it comes to the belt's plane, below the finish.
struct BeltLanding {
  /// @return false of one that moves away from the belt there: it comes from below, and never lands
  [[nodiscard]] bool lands() const noexcept { return speed_into >= -kBeltLandingRounding * speed; }

  double speed_along = 0.0;   ///< of the stream along the belt [m/s]
  double speed_into = 0.0;    ///< square to it, downwards [m/s]
  double speed_across = 0.0;  ///< in the belt's plane, square to its run, to the left [m/s]
  double speed = 0.0;         ///< [m/s]
  double time = 0.0;          ///< through the air [s]
  double reach = 0.0;         ///< horizontal way through the air [m]
  double off_centre = 0.0;    ///< of it across the belt: how far beside the finish it lands [m]
  double match = 0.0;         ///< speed_along over the belt's
  /// K_b = W_a/(mu_b rho v_e^3), v_e the speed on landing; with a level belt, no drop and the belt ahead
  /// cos^2(theta_e) |v_b/v_e - sin(theta_e)|, theta_e from the vertical; >= 0
  double wear_factor = 0.0;
  /// W_a = mu_b rho v_into^2 v_slip [W/m^2]; >= 0. Roberts' v_slip = v_b - v_along is that of a belt ahead of its stream;
  /// a stream that is faster rubs as much the other way, and one from the side rubs across: v_slip is the size of both.
  double wear = 0.0;
};

/// @param slope_angle   of the track at its finish, downhill positive
[[nodiscard]] BeltLanding land_on_belt(double exit_speed, Angle slope_angle, const ReceivingBelt& belt,
                                       double bulk_density, double gravity);

}  // namespace glissade
