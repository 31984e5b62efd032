#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/scaled_problem.hpp"
#include "optimize/search.hpp"

#include <vector>

namespace glissade::optimizer {

/// The track that prices are taken from. A jump that lies a little beside its knots costs next to nothing, but
/// its first order shows in the prices: here pieces next to jumps are halved a few times, with ripples that
/// nobody should build.
/// @return the track itself where that does not arrive
[[nodiscard]] Found priced(const ScaledProblem& problem, Found found, const OptimizeOptions& options,
                           SearchControl& control);

/// The limits that carry multipliers, each with where it binds and its price, in the order of their keys.
[[nodiscard]] std::vector<ActiveLimit> active_limits(const ScaledProblem& problem, const Found& found);

}  // namespace glissade::optimizer
