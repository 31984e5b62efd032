#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/units.hpp"

#include <vector>

namespace glissade::reference {

/// A point of a reference curve: computed to 25 digits at a slope angle that is not a double itself.
struct CurvePoint {
  double slope_angle = 0.0;      ///< rounded to a double [rad]
  double slope_remainder = 0.0;  ///< what that rounding left away [rad]
  double x = 0.0;
  double drop = 0.0;
  double time = 0.0;
  double speed = 0.0;
};

/// One case of tests/reference/coulomb_brachistochrone.json; its inputs are exact doubles.
struct CurveCase {
  Endpoints endpoints;
  Friction friction;
  double gravity = 0.0;
  double exit_slope_angle = 0.0;
  double travel_time = 0.0;
  double exit_speed = 0.0;
  double straight_time = 0.0;
  std::vector<CurvePoint> points;
};

[[nodiscard]] std::vector<CurveCase> curve_cases();

/// Moves the body on to a slope angle that is `change` larger, by first derivatives: a reference point lies
/// at a slope angle that is no double.
[[nodiscard]] CoulombState turned_by(CoulombState state, double change, Friction friction, double gravity);

/// @return eps = drop/(mu run) - 1; +infinity without friction
[[nodiscard]] double reach_margin(const Endpoints& endpoints, Friction friction);

}  // namespace glissade::reference
