#pragma once

#include "glissade/centerline/coulomb_brachistochrone.hpp"

#include <vector>

namespace glissade::reference {

/// What a solution is off by, each relative to the true value; an angle below 1 rad, in radians.
struct SolutionErrors {
  double travel_time = 0.0;
  double exit_speed = 0.0;
  double exit_slope_angle = 0.0;
  double straight_time = 0.0;
  double x = 0.0;
  double drop = 0.0;
  double time = 0.0;
  double speed = 0.0;
};

/// The second route to every number of a fastest track: the integrals (B6) to (B8) of docs/theory.md, as they
/// stand there, by Gauss quadrature in 34-digit arithmetic; the finish by secant steps on t_1. It shares with
/// the library neither the phase form nor the equation that is solved.
class PreciseCurve {
 public:
  /// @throws std::runtime_error if the secant steps do not meet drop/run to 22 digits
  explicit PreciseCurve(const CoulombSolution& solution);

  /// @param slope_angles  where to compare the body on its way; those on the track, as doubles
  [[nodiscard]] SolutionErrors errors(const std::vector<double>& slope_angles) const;

  /// @return distance between the curve's point at the arc length where it should have that slope, and the
  ///         true point there, relative to the length of the track
  [[nodiscard]] double position_error(const CoulombBrachistochrone& track, double slope_angle) const;

 private:
  CoulombSolution solution_;
  double exit_slope_ = 0.0;  // t_1, in two parts
  double exit_slope_remainder_ = 0.0;
};

}  // namespace glissade::reference
