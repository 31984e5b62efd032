#pragma once

#include "optimize/search.hpp"

#include <optional>

namespace glissade::optimizer {

/// An optimum among those of neighbouring meshes: knots go to where moving them wins nothing.
///
/// On one mesh the places of the knots are given, and with them those where curvature can jump or bend: the
/// multipliers are those of tracks that can't do so elsewhere. The derivative of the optimum by the place of a knot is
/// that of the Lagrangian, all else fixed; knots close before and behind a jump go together. Meshes are compared by
/// their optima, steps are those of a quasi-Newton method.
/// @param begun  an optimum on its mesh
/// @param tolerance  residual that the optima are to keep
/// @return the best optimum; none where jumps of the curvature lie well, or nothing is won
[[nodiscard]] std::optional<Found> with_moved_knots(const ScaledProblem& problem, const Found& begun,
                                                    double tolerance, SearchControl& control);

}  // namespace glissade::optimizer
