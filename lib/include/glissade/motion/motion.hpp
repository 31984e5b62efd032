#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace glissade {

/// What slides, and on what.
struct Body {
  Friction friction;            ///< between body and track
  double entry_speed = 0.0;     ///< u at the start [m/s]; >= 0; 0 is a start from rest
  double drag_per_metre = 0.0;  ///< k = rho_air c_d A / (2 m) [1/m]; >= 0
};

/// The body at one station.
struct MotionState {
  double arc_length = 0.0;     ///< [m]
  double time = 0.0;           ///< since the start [s]
  double speed = 0.0;          ///< u [m/s]
  double normal_load = 0.0;    ///< N = g cos(zeta) + kappa u^2 per unit mass [m/s^2]
  double friction_loss = 0.0;  ///< energy per unit mass lost to friction since the start [J/kg]
  double drag_loss = 0.0;      ///< energy per unit mass lost to drag since the start [J/kg]
};

/// How a ride ended before the finish: the speed fell to zero.
struct Stall {
  double arc_length = 0.0;     ///< where the body comes to rest [m]
  double missing_slope = 0.0;  ///< friction angle minus slope angle there: the slope it lacks to go on [rad];
                               ///< >= 0, 0 where the slope angle is the friction angle
};

/// How a ride ended before the finish: the body left the track.
struct LiftOff {
  double arc_length = 0.0;  ///< the first place beyond which the normal load would be negative [m]
  double speed = 0.0;       ///< [m/s]
  double curvature = 0.0;   ///< of the track just after that point [1/m]; negative on a crest
};

/// The ride of one body down one centerline: the referee of everything that Glissade reports.
///
/// Solves dv/ds = 2 g sin(zeta) - 2 mu N - 2 k v, N = g cos(zeta) + kappa v, v = u^2 (docs/theory.md, energy
/// equation) through its integrating factor, by Chebyshev panels between the centerline's breaks, each halved
/// until speed, time and load are resolved to some 1e-14. Starts from rest, slow starts, unbounded curvature
/// at the start and stops are integrated in s = r^2 from the place of rest, where 1/u has an integrable
/// singularity. It knows nothing of how the centerline was found.
///
/// Ends: at the finish (arrived), at a stall, or at a lift-off, whichever comes first. A normal load down to
///   -1e-12 g counts as contact, so that free fall along a track (N = 0) is not lost to rounding. A body
///   whose speed at the finish rounding cannot tell from zero arrives there with exit speed 0.
/// Accuracy: kMotionAccuracy relative in speed and travel time, if the centerline's slope angle is exact to a
///   few units in the last place of s and zeta; measured in docs/accuracy.md.
/// Domain: a centerline that is smooth between its breaks(). A bump narrower than some 1/40 of a smooth
///   stretch that no break tells of may go unseen.
/// Identity: u^2/2 + friction_loss + drag_loss = g drop + entry_speed^2/2 at every station. The losses are
///   integrals of N and v, the speed is not computed from them.
/// Cost: the constructor evaluates direction() at 17 places for each of some 4 to 100 panels, and at least
///   one panel for each smooth stretch; at() is O(log panels).
class Motion {
 public:
  /// Rides the whole track, or up to the stall or lift-off.
  /// @param gravity  [m/s^2]; finite, > 0
  /// @throws InputError if there is no centerline, entry_speed or drag_per_metre is negative or not finite,
  ///         or gravity is not positive and finite
  /// @throws ConvergenceError if the centerline is so rough between its breaks that no panels resolve it
  Motion(CenterlinePtr centerline, Body body, double gravity = kDefaultGravity);
  ~Motion();
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;
  Motion(Motion&&) noexcept;
  Motion& operator=(Motion&&) noexcept;

  [[nodiscard]] const Centerline& centerline() const noexcept;
  [[nodiscard]] const Body& body() const noexcept;
  [[nodiscard]] double gravity() const noexcept;

  /// @return true if the body reached the finish
  [[nodiscard]] bool arrived() const noexcept;
  [[nodiscard]] const std::optional<Stall>& stall() const noexcept;
  [[nodiscard]] const std::optional<LiftOff>& lift_off() const noexcept;

  /// @return how far the body came [m]; the length of the centerline if it arrived
  [[nodiscard]] double distance() const noexcept;
  /// @return time from the start to distance() [s]; +infinity if the body never moves (it stalls at 0) or
  ///         comes to the finish, without end, where the slope angle is the friction angle (it stalls there)
  [[nodiscard]] double travel_time() const noexcept;
  /// @return speed at distance() [m/s]
  [[nodiscard]] double exit_speed() const noexcept;
  /// @return station of the highest / lowest normal load, and of the highest speed, over the whole ride; the
  ///         value to 1e-12, its place to 1e-7. Where curvature jumps, the load on the side that counts: it
  ///         may differ from at(arc_length).normal_load, which is that after the jump. +infinity where a
  ///         moving body enters a track of unbounded curvature.
  [[nodiscard]] MotionState highest_load() const;
  [[nodiscard]] MotionState lowest_load() const;
  [[nodiscard]] MotionState highest_speed() const;

  /// @param s  arc length [m]; 0 <= s <= distance()
  /// @return the body there; at a jump of curvature with the load just after it
  /// @throws InputError if s lies outside the ride
  [[nodiscard]] MotionState at(double s) const;
  /// @param stations  ascending arc lengths, each as for at()
  [[nodiscard]] std::vector<MotionState> at(const std::vector<double>& stations) const;

 private:
  class Ride;
  std::unique_ptr<const Ride> ride_;
};

/// Stated bound of the relative error of Motion's speeds and times, measured in docs/accuracy.md.
inline constexpr double kMotionAccuracy = 1e-10;

}  // namespace glissade
