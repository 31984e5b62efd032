#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/core/units.hpp"

#include <array>
#include <vector>

/// The formulas of S. P. Pudasaini, "The Frictional Brachistochrone", arXiv 2502.00368, one function an
/// equation, for a reader who holds the paper beside the code. Glissade computes with ConstantSpeedCurve,
/// which the tests compare with every one of them.
///
/// Frame: the paper's: x along the run, y downwards, zeta below the horizontal.
/// Source: docs/theory.md, constant-speed track, which also says what two of the equations lack.
namespace glissade::pudasaini {

/// What an equation of the paper is evaluated for.
struct Setting {
  Friction friction;                 ///< mu = tan(delta); > 0
  double gravity = kDefaultGravity;  ///< g [m/s^2]; > 0
  double p = 100.0;                  ///< P [m^2/s^2]; > 0
};

/// Below eq. 18: scaled gravity g/P [1/m].
[[nodiscard]] double scaled_gravity(const Setting& setting);

/// Below eq. 18: lambda = g/(P mu) [1/m].
/// @throws InputError if mu = 0; so does every function below that needs lambda
[[nodiscard]] double lambda(const Setting& setting);

/// Eq. 7: speed of a body from rest after the arc length s of any track, its integral by quadrature.
/// @param s  [m]; within the track
/// @return [m/s]
/// @throws InfeasibleError if the formula gives a negative square: the body stalled before
[[nodiscard]] double speed_from_rest(const Centerline& track, double s, Friction friction, double gravity);

/// Eq. 8 and 9: travel time of a body from rest along the whole of any track, by nested quadrature.
/// @return [s]; to about 1e-9 relative, much slower than Motion
/// @throws InfeasibleError as speed_from_rest()
[[nodiscard]] double travel_time_from_rest(const Centerline& track, Friction friction, double gravity);

/// Eq. 15, the first-order form: d zeta/ds [rad/m].
[[nodiscard]] double slope_angle_rate(Angle slope_angle, const Setting& setting);

/// The constant that eq. 17 lacks, as its value at one point of the track fixes it: c = zeta - lambda (mu x -
/// y). It is the entry slope angle where x and y count from the start; the paper's equation holds for an
/// entry that is level.
[[nodiscard]] double offset(double x, double y, Angle slope_angle, const Setting& setting);

/// Eq. 17, with its constant: dy/dx = tan[lambda (mu x - y) + c].
[[nodiscard]] double slope(double x, double y, double offset, const Setting& setting);

/// Eq. 18, the second-order form: y'' = lambda (1 + y'^2)(mu - y') [1/m].
[[nodiscard]] double slope_derivative(double slope, const Setting& setting);

/// Eq. 19, the exact implicit solution, solved for its constant K, with the absolute value that its logarithm
/// needs where the track is steeper than mu:
///   (1 + mu^2)(K + lambda x) = mu Z - ln|mu cos Z - sin Z|,  Z = lambda (mu x - y) + c.
/// @return K [-]: the same at every point of a track
/// @throws InputError where the slope equals mu: the straight line is not among the solutions of eq. 19
[[nodiscard]] double implicit_constant(double x, double y, double offset, const Setting& setting);

/// Section 3.2, the straight limit: how far at most the track strays from the chord between its ends,
/// measured square to the chord [m]. Tends to 0 as mu nears the mean slope, and as P grows.
[[nodiscard]] double sag(const ConstantSpeedCurve& curve);

/// Figure 1: P, and its seven friction angles in the paper's order [deg].
inline constexpr double kFigureOneP = 100.0;
inline constexpr std::array<double, 7> kFigureOneFrictionAnglesDeg{11.0, 13.0, 15.0, 17.0, 20.0, 25.0, 40.0};

/// Endpoints for figure 1. The paper prints none, nor the scale of its axes. These are ours: a mean slope of
/// 45 deg is steeper than every friction angle of the figure, and P = 100 m^2/s^2 is large enough for all
/// seven.
inline constexpr Endpoints kFigureOneEndpoints{2.5, 2.5};

/// @return the seven curves of figure 1 between the endpoints, in the order of the friction angles
/// @throws InputError as ConstantSpeedCurve
[[nodiscard]] std::vector<ConstantSpeedCurve> figure_one(Endpoints endpoints = kFigureOneEndpoints,
                                                         double p = kFigureOneP,
                                                         double gravity = kDefaultGravity);

}  // namespace glissade::pudasaini
