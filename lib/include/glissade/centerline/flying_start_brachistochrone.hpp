#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/reach.hpp"
#include "glissade/core/units.hpp"

#include <memory>
#include <string_view>
#include <vector>

namespace glissade {

/// Share of the free-fall speed sqrt(g chord) below which an entry speed v0 makes no difference but its lead v0/g: the
/// track is that from rest. measured: the time is at most 1e-11 above the optimum (friction coefficients to 3); the
/// track that is solved for itself loses digits of its flight instead, exit speeds 1e-9 at this share.
inline constexpr double kRestShare = 1e-11;

/// A track that turns by less on its way, and is none of free flight, is a straight line [rad]. measured: nowhere
/// farther than 2e-9 of its length from the fastest one, whose time is that of the straight line to rounding; solved
/// for itself it is as far off where it turns that little, and farther where less.
inline constexpr double kStraightTurn = 1e-8;

/// In which limit of the theory a track is found.
enum class FlyingStartLimit {
  none,
  rest,     ///< entry speed below kRestShare: the track from rest, see CoulombBrachistochrone
  straight  ///< so fast that it turns by less than kStraightTurn, and pressed on the track; or all but vertical
};

/// What fixes one fastest track with an entry speed: slopes t = tan(zeta) and two sizes.
///
/// All but the coefficient 0 in a limit.
/// Curve: a parabola of free flight from slope t0 to t_j >= t0, then the pressed part of docs/theory.md,
///   fastest track, (B4) and (B5), on which the slope falls from t_j to t1.
struct FlyingStartShape {
  double friction_coefficient = 0.0;  ///< mu [-]
  double entry_slope = 0.0;           ///< t0 = tan(zeta_0)
  double flight_turn = 0.0;           ///< d = t_j - t0; >= 0, 0 without friction
  double flight_end_slope = 0.0;      ///< t_j = tan(zeta_j)
  double exit_slope = 0.0;            ///< t1 = tan(zeta_1)
  double flight_end_e = 0.0;          ///< E(t_j) > 0; 0 if all of the track is flight
  double horizontal_speed = 0.0;      ///< u cos(zeta) of the flight [m/s]; 0 for a vertical track
};

/// The fastest track between two points for a body that enters with speed, under Coulomb friction on the full
/// normal load, N >= 0, the entry slope angle free.
///
/// Regular value; holds no heap memory.
/// Source: docs/theory.md, fastest track with an entry speed; S. Salinic, Acta Mechanica 208 (2009) 97.
/// Accuracy: flying_start_accuracy(margin) relative, see there; kRestShare and kStraightTurn in the limits.
/// Identity: travel_time is no longer than that of the straight line; (V4) holds between the slopes; the first
///   part is lossless, so that the speed at its end is sqrt(v0^2 + 2 g flight.drop).
struct FlyingStartSolution {
  double travel_time = 0.0;      ///< from start to finish [s]
  double exit_speed = 0.0;       ///< at the finish [m/s]
  Angle entry_slope_angle;       ///< zeta_0
  Angle flight_end_slope_angle;  ///< zeta_j; >= zeta_0
  Angle exit_slope_angle;        ///< zeta_1; <= zeta_j
  double flight_time = 0.0;      ///< of the first part [s]
  Endpoints flight;              ///< run and drop of the first part [m]
  double entry_speed = 0.0;      ///< v0 [m/s]
  double gravity = 0.0;          ///< [m/s^2]
  Endpoints endpoints;
  FlyingStartShape shape;
  FlyingStartLimit limit = FlyingStartLimit::none;

  /// @return true if the whole track is free flight: g L <= v0 v1 sin(delta) with v1^2 = v0^2 + 2 g H
  [[nodiscard]] bool all_flight() const noexcept {
    return limit == FlyingStartLimit::none && shape.flight_end_e == 0.0;
  }
};

/// Finds the fastest track of a body that enters with speed. Allocates nothing unless it throws.
/// @param endpoints    run [m], finite, any sign (a negative run is the mirror image), 0 is a vertical line;
///                     drop [m], finite, any sign, > least_drop(); the longer of both kShortestWay to
///                     kLongestWay
/// @param entry_speed  v0 [m/s]; finite, > 0, however small or large
/// @param gravity      [m/s^2]; kWeakestGravity to kStrongestGravity
/// @throws InputError if a number is outside its stated range, or the friction coefficient is above kRoughest
/// @throws ConvergenceError if no track is found: next to the limit of what can be reached, or all but flat
/// @throws InfeasibleError if drop <= least_drop(), or an entry speed below kRestShare would be needed to exceed it:
///         no track whatever reaches the finish
[[nodiscard]] FlyingStartSolution solve_flying_start(const Endpoints& endpoints, Friction friction,
                                                     double entry_speed, double gravity = kDefaultGravity);

/// Bound of the relative error of a FlyingStartSolution, measured in docs/accuracy.md; of angles the absolute
/// error in radians where they are below 1 rad. The square of the exit speed may be off by
/// kFlyingStartRounding (v0^2 + 2 g chord) besides, which tells where it is small.
///
/// Holds for friction coefficients from 0 to 3 and v0^2/(g chord) from 1e-8 to 1e8.
/// @param margin  (H - least_drop)/(chord + v0^2/g) > 0: how far the finish lies inside what can be reached
[[nodiscard]] constexpr double flying_start_accuracy(double margin) {
  return 1e-12 + 1e-15 / margin;
}

inline constexpr double kFlyingStartRounding = 1e-14;

namespace centerline {
class SlopeTable;
}

/// Kind "fastest" with an entry speed: free flight along the track, then pressed on it to the finish.
///
/// Frame: as CenterlinePoint; x counts towards the finish on whichever side of the start it lies.
/// Curve: curvature -g cos^3(zeta)/(v0 cos(zeta_0))^2 on the flight, where the normal load is 0; it jumps at
///   flight_length(), a break, to a positive one. Without friction there is no flight, far faster than gravity
///   needs there is nothing else. A vertical one (run 0) is a straight line. In the limit of rest it starts
///   vertically, and with the curvature that the track from rest has after kRestShare^2 of its length: a body
///   that enters with so little speed feels nothing of more.
/// Source: docs/theory.md, fastest track with an entry speed; slope angle over arc length by Chebyshev pieces.
/// Accuracy: position to kPositionAccuracy of the length for margins above 1e-3, see flying_start_accuracy; without
///   a flight to 1e-16/turn [rad] besides, kStraightTurn at the least. Steeper than chord/run 1e9 it is the straight line,
///   to 1e-9.
/// Identity: the referee Motion, started with entry_speed, finds travel_time and exit_speed of solution().
class FlyingStartBrachistochrone final : public Centerline {
 public:
  /// Stated bound of the position error relative to the length, measured in docs/accuracy.md.
  static constexpr double kPositionAccuracy = 1e-12;

  /// @throws as solve_flying_start
  FlyingStartBrachistochrone(const Endpoints& endpoints, Friction friction, double entry_speed,
                             double gravity = kDefaultGravity);

  [[nodiscard]] const FlyingStartSolution& solution() const noexcept { return solution_; }
  /// @return where the flight ends [m]; 0 where there is none
  [[nodiscard]] double flight_length() const noexcept { return flight_length_; }

  [[nodiscard]] std::string_view kind() const noexcept override { return "fastest"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  [[nodiscard]] std::vector<double> breaks() const override;
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override;

 private:
  [[nodiscard]] double curvature(double s, double slope_angle) const;
  [[nodiscard]] double beyond_start(double s) const;

  FlyingStartSolution solution_;
  double flight_length_ = 0.0;
  double length_ = 0.0;
  std::shared_ptr<const CoulombBrachistochrone> rest_;     // in the limit of rest alone
  std::shared_ptr<const centerline::SlopeTable> flight_;   // none without a flight
  std::shared_ptr<const centerline::SlopeTable> pressed_;  // none where all is flight
};

}  // namespace glissade
