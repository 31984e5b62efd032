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
                               ///< > 0 unless the body only just came to rest
};

/// How a ride ended before the finish: the body left the track.
struct LiftOff {
  double arc_length = 0.0;  ///< where the normal load would turn negative [m]
  double speed = 0.0;       ///< [m/s]
  double curvature = 0.0;   ///< of the track just after that point [1/m]; negative (a crest)
};

/// The ride of one body down one centerline: the referee of everything that Glissade reports.
///
/// Solves dv/ds = 2 g sin(zeta) - 2 mu N - 2 k v, N = g cos(zeta) + kappa v, v = u^2 (docs/theory.md, energy
/// equation) through its integrating factor, panel by panel, each panel refined until both speed and time
/// meet the tolerance; the integrable singularity of 1/u at rest is removed by the substitution s = r^2. It
/// knows nothing of how the centerline was found. Accuracy: kMotionAccuracy relative in speed and travel
/// time. Identity: kinetic + friction_loss + drag_loss = g drop + entry_speed^2 / 2 at every station.
class Motion {
 public:
  /// Rides the whole track, or up to the stall or lift-off.
  /// @param gravity  [m/s^2]; finite, > 0
  /// @throws InputError if entry_speed or drag_per_metre is negative or not finite, or gravity is not
  /// positive
  Motion(CenterlinePtr centerline, Body body, double gravity = kDefaultGravity);
  ~Motion();
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
  /// @return time from the start to distance() [s]; +infinity if the body never moves or creeps to rest
  /// without end
  [[nodiscard]] double travel_time() const noexcept;
  /// @return speed at distance() [m/s]
  [[nodiscard]] double exit_speed() const noexcept;
  /// @return station of the highest / lowest normal load, and of the highest speed, over the whole ride
  [[nodiscard]] MotionState highest_load() const;
  [[nodiscard]] MotionState lowest_load() const;
  [[nodiscard]] MotionState highest_speed() const;

  /// @param s  arc length [m]; 0 <= s <= distance()
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
