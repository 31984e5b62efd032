#pragma once

#include "glissade/centerline/coulomb_brachistochrone.hpp"

namespace glissade::centerline {

/// @return tan(phi/2) where the track of `solution` has that slope angle
/// @throws InputError if it has it nowhere, or everywhere (a vertical track)
[[nodiscard]] double half_tangent_at_slope_angle(const CoulombSolution& solution, double slope_angle);

/// @param half_tangent  tan(phi/2); from 0 to that of the finish; the track is not vertical
[[nodiscard]] CoulombState coulomb_state(const CoulombSolution& solution, double half_tangent);

/// @return curvature [1/m] at tan(phi/2); +infinity at the start
[[nodiscard]] double coulomb_curvature(const CoulombShape& shape, double half_tangent);

/// @return zeta [rad] at tan(phi/2)
[[nodiscard]] double coulomb_slope_angle(const CoulombShape& shape, double half_tangent);

/// @return ds/d(phi) [m/rad] at tan(phi/2)
[[nodiscard]] double arc_length_slope(const CoulombShape& shape, double half_tangent);

}  // namespace glissade::centerline
