#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace glissade {

/// How far below the exit slope angle a slope angle may lie and still mean the finish [rad]: the rounding of
/// a slope angle that was computed on the way.
inline constexpr double kSlopeAngleRounding = 1e-15;

/// The body at one point of a fastest track, by the track's own closed laws.
struct CoulombState {
  double slope_angle = 0.0;  ///< zeta, below the horizontal, positive downhill [rad]
  double x = 0.0;            ///< run from the start, positive towards the finish [m]
  double drop = 0.0;         ///< y, positive below the start [m]
  double curvature = 0.0;    ///< kappa, > 0; +infinity at the start [1/m]
  double speed = 0.0;        ///< u [m/s]
  double time = 0.0;         ///< since the start [s]
};

/// What fixes one fastest track: its shape and its size. All zero for a vertical one.
///
/// Curve: tan(zeta) = mu + q cot(phi); the phase phi runs from 0 (vertical start) to phi_1 < pi (finish).
struct CoulombShape {
  double friction_coefficient = 0.0;       ///< mu [-]
  double q = 0.0;                          ///< q of docs/theory.md, fastest track; > 0 [-]
  double finish_phase_half_tangent = 0.0;  ///< tan(phi_1 / 2); > 0 [-]
  double scale = 0.0;                      ///< C / (2 q^3) with C of docs/theory.md, fastest track [m]
};

/// The fastest track from rest between two points under Coulomb friction on the full normal load.
///
/// Regular value; holds no heap memory.
/// Source: docs/theory.md, fastest track.
/// Accuracy: coulomb_accuracy(eps) relative, see there.
/// Identity: exit_speed^2 <= 2 g (H - mu L) e^(2 mu (exit_slope_angle - delta)); travel_time < straight_time
///   unless the track is vertical; exit_slope_angle > 2 delta - 90 deg.
struct CoulombSolution {
  double travel_time = 0.0;    ///< from start to finish [s]
  double exit_speed = 0.0;     ///< at the finish [m/s]
  Angle exit_slope_angle;      ///< zeta_1; negative where the track rises towards the finish
  double straight_time = 0.0;  ///< travel time of the straight ramp between the same points [s]
  double gravity = 0.0;        ///< [m/s^2]
  Endpoints endpoints;
  CoulombShape shape;

  /// @param slope_angle  zeta; exit_slope_angle - kSlopeAngleRounding <= zeta <= 90 deg
  /// @return the body where the track has that slope; each slope occurs once
  /// @throws InputError if zeta lies outside that range, or the track is vertical (one slope everywhere)
  [[nodiscard]] CoulombState at_slope_angle(Angle slope_angle) const;
};

/// Finds the fastest track from rest. Allocates nothing unless it throws.
/// @param endpoints  run [m], finite, any sign (a negative run is the mirror image), 0 is free fall along a
///                   vertical line; drop [m], finite, > 0 and > mu |run|; the longer of both kShortestWay to
///                   kLongestWay
/// @param gravity    [m/s^2]; kWeakestGravity to kStrongestGravity
/// @throws InputError if run or drop is not finite, drop is not positive, the way or gravity is out of
///         its range, or the friction coefficient is above kRoughest
/// @throws InfeasibleError if drop <= mu |run|: from rest, no track whatever reaches the finish
[[nodiscard]] CoulombSolution solve_coulomb_brachistochrone(const Endpoints& endpoints, Friction friction,
                                                            double gravity = kDefaultGravity);

/// Bound of the relative error of a CoulombSolution, measured in docs/accuracy.md.
///
/// Holds for friction coefficients from 0 to 3, lengths from 1 mm to 100 km and drop/run up to 1e12; for the
/// exit slope angle it is the absolute error in radians where the angle is below 1 rad.
/// @param reach_margin  eps = drop/(mu run) - 1; > 0, +infinity without friction. Near the limit of what can
///                      be reached one rounding of an input moves the answer by 1e-16/eps.
[[nodiscard]] constexpr double coulomb_accuracy(double reach_margin) {
  return 1e-12 + 1e-15 / reach_margin;
}

/// Kind "fastest": the exact frictional brachistochrone from rest, by arc length.
///
/// Frame: as CenterlinePoint; x counts towards the finish on whichever side of the start it lies.
/// Curve: starts vertically (slope angle pi/2) with curvature unbounded like s^(-1/2), concave throughout,
///   ends at exit_slope_angle. A vertical one (run 0) is a straight line of slope angle pi/2 and curvature 0.
/// Source: docs/theory.md, fastest track; arc length by Gauss quadrature of its derivative, inverted once, in
///   the constructor, into Chebyshev pieces of the phase over sqrt(s).
/// Accuracy: position to kPositionAccuracy of the length, and relative to its own size near the start
///   (x ~ s^(3/2)).
/// Identity: the referee Motion, started from rest, finds travel_time and exit_speed of solution().
class CoulombBrachistochrone final : public Centerline {
 public:
  /// Stated bound of the position error relative to the length, measured in docs/accuracy.md.
  static constexpr double kPositionAccuracy = 1e-13;

  /// @throws as solve_coulomb_brachistochrone
  CoulombBrachistochrone(const Endpoints& endpoints, Friction friction, double gravity = kDefaultGravity);

  [[nodiscard]] const CoulombSolution& solution() const noexcept { return solution_; }

  [[nodiscard]] std::string_view kind() const noexcept override { return "fastest"; }
  [[nodiscard]] double length() const noexcept override { return length_; }
  [[nodiscard]] CenterlinePoint at(double s) const override;
  [[nodiscard]] double slope_angle(double s) const override;
  [[nodiscard]] Direction direction(double s) const override;
  [[nodiscard]] bool unbounded_curvature_at_start() const noexcept override { return !pieces_.empty(); }

  /// @param slope_angle  zeta; as for CoulombSolution::at_slope_angle
  /// @return arc length where the track has that slope [m]
  /// @throws InputError if zeta lies outside that range, or the track is vertical
  [[nodiscard]] double arc_length_at_slope_angle(Angle slope_angle) const;

  /// The body at arc length s, by the track's closed laws: no simulation.
  /// @param s  arc length [m]; 0 <= s <= length()
  /// @throws InputError if s lies outside the track
  [[nodiscard]] CoulombState state_at(double s) const;

 private:
  static constexpr std::size_t kTerms = 16;

  /// One piece of the way back from arc length to phase: a Chebyshev series in r = sqrt(s) for the local half
  /// tangent v = tan(phi/2), or tan((pi - phi)/2) beyond phi = pi/2; in the first piece, for v/r.
  struct Piece {
    double first_root = 0.0;  // r
    double last_root = 0.0;
    double first_half_tangent = 0.0;  // v
    double last_half_tangent = 0.0;
    bool upper_half = false;  // phi > pi/2
    std::array<double, kTerms> coefficients{};

    [[nodiscard]] double root_at(double position) const;
    [[nodiscard]] bool resolved() const;
    [[nodiscard]] double half_tangent(double root) const;
  };
  class Tabulation;

  [[nodiscard]] double phase_half_tangent(double s) const;

  CoulombSolution solution_;
  double length_ = 0.0;
  std::vector<Piece> pieces_;  // none where the track is vertical
};

}  // namespace glissade
