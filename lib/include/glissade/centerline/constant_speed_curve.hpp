#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

#include <functional>

namespace glissade {

/// Pudasaini's curve, "constant-speed" in a design file: the track on which friction takes exactly what
/// gravity gives, so that a body fed at u = sqrt(P) keeps that speed from start to finish.
///
/// It is not the fastest track from rest (docs/theory.md, constant-speed track, says why and by how much).
///
/// Frame: as Centerline. Turned by the friction angle delta the curve is elementary: psi = zeta - delta obeys
///   d psi/ds = -k sin(psi), k = g/(P sin delta).
/// Curve: analytic. Concave (a valley, curvature > 0, flattening towards delta) where the mean slope is
///   steeper than the friction angle; the straight line where it equals it; convex (a crest, steepening
///   towards delta) where it is flatter.
/// Source: docs/theory.md (C1) to (C13); S. P. Pudasaini, The Frictional Brachistochrone, arXiv 2502.00368,
///   eq. 15 to 19.
/// Accuracy: kConstantSpeedCurveAccuracy, for every P from smallest_p() to the straight line.
/// Identity: normal load of a body at u = sqrt(P) is g sin(zeta)/mu; v = u^2 depends on the angle turned
///   alone.
class ConstantSpeedCurve final : public Centerline {
 public:
  /// The track between two points for a given P; closed form, no iteration.
  /// @param endpoints  run finite and not 0 (its sign is the side; x counts towards the finish), drop finite
  /// @param friction   mu > 0
  /// @param gravity    g [m/s^2]; finite, > 0
  /// @param p          P, the square of the speed that stays constant [m^2/s^2]; finite, >= smallest_p()
  /// @throws InputError if mu = 0 (no friction takes what gravity gives: the kind is undefined), if run = 0,
  ///         if a value is not finite or not positive, or if P < smallest_p() (the message names that P)
  ConstantSpeedCurve(Endpoints endpoints, Friction friction, double gravity, double p);

  /// The initial-value form: the track of a given length that leaves the start at a given slope angle.
  /// @param entry_slope_angle  zeta(0); within -90 to 90 deg
  /// @param length             arc length [m]; finite, > 0
  /// @throws InputError as the constructor, and if the slope angle or the length is out of range
  [[nodiscard]] static ConstantSpeedCurve from_entry_slope(Angle entry_slope_angle, double length,
                                                           Friction friction, double gravity, double p);

  /// The track on which a body that enters at this speed keeps it: P = speed^2.
  /// @param speed  [m/s]; finite, > 0, its square too
  /// @throws InputError as the constructor, and if speed or its square is out of that range
  [[nodiscard]] static ConstantSpeedCurve at_speed(Endpoints endpoints, Friction friction, double gravity,
                                                   double speed);

  /// The one of these tracks on which a body arrives first: argmin over P of its travel time.
  /// @param entry_speed  speed at the start [m/s]; finite, >= 0; 0 is a start from rest
  /// @return its travel time exceeds the least one by at most 1e-12 relative; P itself to 1e-6 relative (the
  ///         minimum is flat). With an entry speed this is not in general the track of at_speed().
  /// @throws InfeasibleError if the mean slope is not steeper than the friction angle (reach theorem)
  /// @throws InputError as the constructor; ConvergenceError if the minimiser gives up
  [[nodiscard]] static ConstantSpeedCurve fastest(Endpoints endpoints, Friction friction, double gravity,
                                                  double entry_speed = 0.0);

  /// Travel time of a body on one of these tracks [s]; +infinity where it does not arrive.
  using TravelTime = std::function<double(const ConstantSpeedCurve&)>;
  /// The same for any body, by its rides: drag, say, has no closed form.
  /// @param travel_time  smooth in P where it is finite; not empty; it may be called some 200 times
  /// @return of all minima that P in steps of e^0.5 shows, the least; as exact as what was given
  /// @throws InfeasibleError as above, and if the body arrives on none of the tracks; others as above, and what
  ///         travel_time throws
  [[nodiscard]] static ConstantSpeedCurve fastest(Endpoints endpoints, Friction friction, double gravity,
                                                  const TravelTime& travel_time);

  /// @return the smallest P with a track between these points that nowhere overhangs [m^2/s^2]: it starts
  ///         vertical (docs/theory.md (C9)); 0 where the mean slope equals the friction angle, as every P
  ///         then gives the straight line
  /// @throws InputError as the constructor
  [[nodiscard]] static double smallest_p(Endpoints endpoints, Friction friction, double gravity);

  [[nodiscard]] std::string_view kind() const noexcept override { return "constant-speed"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;

  /// @param slope_angle  zeta; between the entry and the exit slope angle
  /// @return the arc length where the track has it [m]; closed form
  /// @throws InputError if the track has it nowhere, or everywhere (a straight track)
  [[nodiscard]] double arc_length_at_slope(Angle slope_angle) const;

  [[nodiscard]] Endpoints endpoints() const noexcept { return endpoints_; }
  [[nodiscard]] Friction friction() const noexcept { return friction_; }
  [[nodiscard]] double gravity() const noexcept { return gravity_; }
  /// @return P [m^2/s^2]
  [[nodiscard]] double p() const noexcept { return p_; }
  /// @return sqrt(P), the speed that the track keeps constant [m/s]
  [[nodiscard]] double constant_speed() const noexcept;
  [[nodiscard]] Angle entry_slope_angle() const noexcept;
  [[nodiscard]] Angle exit_slope_angle() const noexcept;
  /// @return angle turned from the start to s [rad]: zeta(0) - zeta(s), negative on a convex track
  [[nodiscard]] double turned_angle(double s) const;

  /// @return true where the mean slope is flatter than the friction angle: a crest, which only a body that
  ///         already moves can follow
  [[nodiscard]] bool is_convex() const noexcept { return psi_entry_ < 0.0; }

  /// @return true if a body at the constant speed is pressed on the track all along: zeta >= 0 everywhere.
  ///         Always so unless the track is convex.
  [[nodiscard]] bool holds_body() const noexcept;

  /// The fastest that a body may be at s without leaving the track, docs/theory.md (C12).
  /// @return [m/s]; infinity on a track that is not a crest
  [[nodiscard]] double lift_off_speed(double s) const;

  /// Speed of a body on this track, docs/theory.md (C10).
  /// @param entry_speed  [m/s]; finite, >= 0
  /// @return [m/s]
  /// @throws InputError if an argument is out of range
  /// @throws InfeasibleError if the body stalls before s or leaves the track at a crest before s
  [[nodiscard]] double speed(double s, double entry_speed = 0.0) const;

  /// Travel time from start to finish of a body on this track, by quadrature of 1/u with the start from rest
  /// taken out of the integral; shares nothing with Motion, which tests compare it to.
  /// @param entry_speed  [m/s]; finite, >= 0
  /// @return [s]
  /// @throws InputError, InfeasibleError as speed() at the finish; InfeasibleError from rest where the mean
  ///         slope is not steeper than the friction angle
  [[nodiscard]] double travel_time(double entry_speed = 0.0) const;

  /// @return travel time of a body that enters at the constant speed: length() / sqrt(P) [s]
  [[nodiscard]] double travel_time_at_constant_speed() const noexcept;

 private:
  ConstantSpeedCurve(Friction friction, double gravity, double p);
  void require_motion(double s, double entry_speed) const;
  [[nodiscard]] double speed_squared(double s, double entry_speed) const;

  Friction friction_;
  double gravity_;
  double p_;
  double delta_;               ///< friction angle [rad]
  double rate_;                ///< k = g/(P sin delta) [1/m]
  double psi_entry_ = 0.0;     ///< zeta - delta at the start [rad]
  double psi_exit_ = 0.0;      ///< the same at the finish [rad]
  double turned_total_ = 0.0;  ///< psi_entry_ - psi_exit_ = k eta_1 [rad]
  double length_ = 0.0;        ///< [m]
  Endpoints endpoints_;
};

/// Stated bound of the relative error of lengths, angles, speeds and times of a ConstantSpeedCurve whose
/// inputs are exact; the test suite measures it against reference values.
inline constexpr double kConstantSpeedCurveAccuracy = 1e-13;

}  // namespace glissade
