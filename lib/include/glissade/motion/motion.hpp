#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"
#include "glissade/motion/law.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace glissade {

/// A place from which on the track rubs differently.
struct FrictionChange {
  double from = 0.0;  ///< arc length [m]; >= 0
  Friction friction;
};

/// A stream that comes down on the start of a track and slides on, without bounce.
struct Landing {
  double speed = 0.0;  ///< V1, before the impact [m/s]; finite, > 0
  Angle angle;         ///< of its way below the horizontal
};

/// What the speed of a body may be where it enters a track [m/s].
inline constexpr double kFastestEntry = 1e100;

/// @return V2 = V1 (cos(theta) - sin(theta) tan(phi)), theta the angle between the way and the track [m/s]; not
///         positive where friction takes all of it
/// Source: Stuart-Dick & Royal 1991; docs/chutes.md, feed
[[nodiscard]] double speed_after(const Landing& landing, Angle slope_angle, Friction friction);

struct Body;

/// What a body does before it comes down on the start of a track, where that depends on the body: a stream under a hood.
class Approach {
 public:
  virtual ~Approach() = default;
  /// @param body  on its way down, with the friction and the law that it has on the track
  /// @return how it comes down on the start
  [[nodiscard]] virtual Landing landing(const Body& body) const = 0;
  /// @return true if it falls away on its way, so that it comes down elsewhere: a stream that loses its hood
  [[nodiscard]] virtual bool falls_away(const Body& body) const = 0;

 protected:
  Approach() = default;
  Approach(const Approach&) = default;
  Approach(Approach&&) = default;
  Approach& operator=(const Approach&) = default;
  Approach& operator=(Approach&&) = default;
};

/// What slides, rolls or flows, and on what.
struct Body {
  Friction friction;            ///< between body and track; of a rolling body its rolling resistance
  double entry_speed = 0.0;     ///< u at the start [m/s]; >= 0; 0 is a start from rest
  double drag_per_metre = 0.0;  ///< k = rho_air c_d A / (2 m) [1/m]; >= 0
  /// Friction from these places on, by ascending place; `friction` holds before the first.
  std::vector<FrictionChange> friction_changes = {};
  /// Wind along the track, against the motion where positive [m/s]: drag is k (u + w)|u + w|.
  double head_wind = 0.0;
  LawPtr law = nullptr;  ///< none: a sliding point
  /// How it comes down on the start; entry_speed is then what the impact leaves, of a Motion's body() known.
  std::optional<Landing> landing = {};
  /// Where that depends on friction and law: it then says what `landing` is, of a Motion's body() known.
  std::shared_ptr<const Approach> approach = nullptr;
  /// Held from both sides, as by a rail that it runs on and one above it: it leaves no track, and what rubs is |N|.
  bool held = false;
};

/// @return how a body comes down on the start of its track; none of one that enters along it
[[nodiscard]] std::optional<Landing> landing_of(const Body& body);

/// The body on the part of its track from a place on: its friction, and the law where that changes along the track, are those
/// of there. How it enters stays what it is.
/// @param start  arc length of the whole track [m]; >= 0
[[nodiscard]] Body body_from(Body body, double start);

/// Whether the wind, too, can drive a body: it blows from behind one that has drag.
[[nodiscard]] constexpr bool is_driven_by_wind(const Body& body) {
  return body.head_wind < 0.0 && body.drag_per_metre > 0.0;
}

/// Whether a body is the sliding point of Coulomb's law with one friction everywhere and no wind, whose
/// optimum without limits, constant-speed track and reach have closed forms (docs/theory.md).
[[nodiscard]] bool is_sliding_point(const Body& body);
/// @return the least friction anywhere on the track, and c at any speed is no less
[[nodiscard]] Friction least_friction(const Body& body);

/// The body at one station.
struct MotionState {
  double arc_length = 0.0;  ///< [m]
  double time = 0.0;        ///< since the start [s]
  double speed = 0.0;       ///< u of the centre of mass [m/s]
  /// N = g cos(zeta) + kappa u^2/(1 - kappa h) per unit mass [m/s^2]; negative where a body that is held presses upwards
  double normal_load = 0.0;
  double friction_loss = 0.0;  ///< energy per unit mass lost to friction since the start [J/kg]
  double drag_loss = 0.0;      ///< energy per unit mass lost to drag since the start [J/kg]
};

/// How a ride ended before the finish: the speed fell to zero.
struct Stall {
  double arc_length = 0.0;  ///< where the body comes to rest [m]
  Angle missing_slope;      ///< friction angle minus slope angle there: the slope it lacks to go on;
                            ///< >= 0, 0 where the slope angle is the friction angle
};

/// How a ride ended before the finish: the body left the track.
struct LiftOff {
  double arc_length = 0.0;  ///< the first place beyond which the normal load would be negative [m]
  double speed = 0.0;       ///< [m/s]
  double curvature = 0.0;   ///< of the track just after that point [1/m]; negative on a crest
};

/// How a ride ended before the finish: what the body's law says no longer holds.
struct LawEnd {
  /// The quantity beyond its bound, as LawQuantity::key: "burden_depth_m" where a stream chokes. Or
  /// "valley_radius_m", where a valley is too tight for a body whose centre of mass runs above the track.
  std::string_view what;
  double arc_length = 0.0;  ///< [m]
  double speed = 0.0;       ///< [m/s]
  double value = 0.0;       ///< of the quantity there, after it if it jumps there
  double bound = 0.0;
};

/// Where a quantity of a law is highest, and where it first exceeds its bound.
struct QuantityPeak {
  double value = 0.0;                 ///< may be +infinity
  double arc_length = 0.0;            ///< [m]
  std::optional<double> beyond_from;  ///< first place beyond LawQuantity::highest [m]; none if it never is
};

/// The ride of one body down one centerline: the referee of everything that Glissade reports.
///
/// Solves dv/ds = 2 g sin(zeta) - 2 mu N - 2 k v, N = g cos(zeta) + kappa v, v = u^2 (docs/theory.md, energy
/// equation), or what the body's Law makes of it, through its integrating factor, by Chebyshev panels between the centerline's breaks, each halved
/// until speed, time and load are resolved to some 1e-14. Starts from rest, slow starts, unbounded curvature
/// at the start and stops are integrated in s = r^2 from the place of rest, where 1/u has an integrable
/// singularity. It knows nothing of how the centerline was found.
///
/// Ends: at the finish (arrived), at a stall, at a lift-off, or where the law ends, whichever comes first. A normal load down to
///   -1e-12 g counts as contact, so that free fall along a track (N = 0) is not lost to rounding. A body
///   whose speed at the finish rounding cannot tell from zero arrives there with exit speed 0. A body that is held
///   (Body::held) does not lift off: where N changes its sign friction changes sides, c |N| in place of c N.
/// Accuracy: kMotionAccuracy relative in speed and travel time, if the centerline's slope angle is exact to a
///   few units in the last place of s and zeta; measured in docs/accuracy.md. Of a body that friction or a climb has
///   slowed down the square of the speed is off by kMotionEnergyAccuracy of the greatest square that it had besides:
///   slower than a hundredth of its highest speed it is that which tells (beside the limit of what can be reached).
/// Domain: a centerline that is smooth between its breaks(). A bump narrower than some 1/40 of a smooth
///   stretch that no break tells of may go unseen.
/// Identity: f u^2/2 + friction_loss + drag_loss = g drop + f entry_speed^2/2 at every station, f = 1 and the
///   drop that of the track where there is no law, that of the centre of mass where there is one. The losses
///   are integrals of N and v, the speed is not computed from them.
/// Regular value: never changes, and copies share what was computed.
/// Cost: the constructor evaluates direction() at 17 places for each of some 4 to 100 panels, and at least
///   one panel for each smooth stretch; at() is O(log panels).
class Motion {
 public:
  /// Rides the whole track, or up to the stall or lift-off.
  /// @param gravity  [m/s^2]; kWeakestGravity to kStrongestGravity
  /// @throws InputError if there is no centerline, gravity times its length is above 1e305, entry_speed or drag_per_metre is
  ///         negative or not finite, entry_speed is above kFastestEntry, head_wind is not finite, friction_changes do not
  ///         ascend, gravity is out of its range, a landing has no speed, or a
  ///         law that depends on speed is to start from rest or where curvature is unbounded
  /// @throws ConvergenceError if the centerline is so rough between its breaks that no panels resolve it
  Motion(CenterlinePtr centerline, Body body, double gravity = kDefaultGravity);
  [[nodiscard]] const Centerline& centerline() const noexcept;
  [[nodiscard]] const Body& body() const noexcept;
  [[nodiscard]] double gravity() const noexcept;

  /// @return true if the body reached the finish
  [[nodiscard]] bool arrived() const noexcept;
  [[nodiscard]] const std::optional<Stall>& stall() const noexcept;
  [[nodiscard]] const std::optional<LiftOff>& lift_off() const noexcept;
  [[nodiscard]] const std::optional<LawEnd>& law_end() const noexcept;

  /// @return how far the body came [m]; the length of the centerline if it arrived
  [[nodiscard]] double distance() const noexcept;
  /// @return time from the start to distance() [s]; +infinity if the body never moves (it stalls at 0), or
  ///         comes to the finish, without end, where the slope angle is the friction angle (it stalls there), or, with a
  ///         wind from behind, to where that, slope and friction balance: on the last of its way there, below a thousandth
  ///         of the wind, it is told as standing
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
  /// @param s  as for at()
  /// @return what a law's quantities are computed from there
  [[nodiscard]] LawState law_state(double s) const;
  /// @param stations  ascending arc lengths, each as for at()
  [[nodiscard]] std::vector<MotionState> at(const std::vector<double>& stations) const;

  /// @return what the body's law adds to every station; empty without a law
  [[nodiscard]] std::vector<LawQuantity> quantities() const;
  /// @param index  of quantities()
  /// @param s      as for at()
  /// @return its value there
  [[nodiscard]] double quantity(std::size_t index, double s) const;
  /// @return its highest value over the ride, to 1e-9 relative, and its place: as for a quantity that is given
  [[nodiscard]] QuantityPeak highest(std::size_t index) const;

  /// A value of the body at a place: of a law_state() within the ride.
  using Quantity = std::function<double(const LawState&)>;
  /// The greatest value of anything along a ride; of the least one the quantity's negative. What is told of a ride comes from
  /// here (the referee of limits looks for itself). It is looked for between all samples, and on both sides of each place
  /// where curvature, friction or the law changes.
  /// @param quantity  smooth in between; not empty
  /// @return its highest value, to 1e-9 relative, and its place; of two alike the first
  /// @throws InputError if it is empty
  [[nodiscard]] QuantityPeak highest(const Quantity& quantity) const;
  /// @param quantity  as for highest()
  /// @return its mean over the way, to 1e-9 of its largest size; its value at the start of a ride without one
  /// @throws InputError as highest()
  [[nodiscard]] double mean(const Quantity& quantity) const;
  /// @return ascending places between which the ride is smooth, from 0 to distance() [m]
  [[nodiscard]] std::vector<double> breaks() const;

 private:
  class Ride;
  std::shared_ptr<const Ride> ride_;
};

/// @return whether what comes down on the start of its track meets it: the floor there is no steeper than its way. What
///         does not flies over the start, and its ride stands for nothing; true of a body without a Landing
[[nodiscard]] bool lands(const Motion& motion);
/// @return whether what lands stands there: theta + phi >= 90 deg, theta the angle between its way and the floor and phi the
///         friction angle, so that friction takes all of its speed. Its ride, too, stands for nothing; false without a Landing
[[nodiscard]] bool stands_where_it_lands(const Motion& motion);
/// @return whether a body gets onto its track: it lands there and does not stand where it does. What is told of the ride of
///         another would follow from an impact that is none
[[nodiscard]] bool enters(const Motion& motion);

/// How a ride ended.
enum class RideEnd {
  arrived,
  stalled,
  lifted_off,
  does_not_fit,      ///< into a valley
  choked,            ///< a stream
  flies_over_start,  ///< a feed: !lands()
  stands_at_start    ///< a feed: stands_where_it_lands()
};

[[nodiscard]] RideEnd ride_end(const Motion& motion);
/// @return "arrived", "stalled", "lifted off", "does not fit", "choked", "flies over the start", "stands where it lands"
[[nodiscard]] std::string_view to_text(RideEnd end);

/// Stated bound of the relative error of Motion's speeds and times, measured in docs/accuracy.md; of speeds while the body
/// has a hundredth of its highest speed.
inline constexpr double kMotionAccuracy = 1e-10;
/// Stated bound of the error of the square of a speed, relative to the greatest square of the ride: what the rounding of
/// place and slope angle takes or gives. Measured on fastest tracks from rest that end as slowly as 1e-6 of their highest
/// speed, drops from 1e-4 of it above the limit of what can be reached.
inline constexpr double kMotionEnergyAccuracy = 1e-11;

}  // namespace glissade
