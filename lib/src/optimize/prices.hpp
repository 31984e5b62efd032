#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/scaled_problem.hpp"
#include "optimize/search.hpp"

#include <vector>

namespace glissade::optimizer {

/// The track that prices are taken from. A jump that lies a little beside its knots costs next to nothing, but
/// its first order shows in the prices: here pieces next to jumps are halved a few times, with ripples that
/// nobody should build. Where a mesh whose every piece is halved has other prices, so are all pieces.
/// @param ahead  multipliers of each limit on such a mesh (Outlook::by_limit); none where it was not looked at
/// @return the track itself where that does not arrive
[[nodiscard]] Found priced(const ScaledProblem& problem, Found found, const Vector& ahead,
                           const OptimizeOptions& options, SearchControl& control);

/// The limits that carry multipliers, and straight ends that cost something, each with where it binds and its price, in
/// the order of their keys.
/// @param objective  multiplier of the objective: 1; 0 where a row alone is made least
[[nodiscard]] std::vector<ActiveLimit> active_limits(const ScaledProblem& problem, const Found& found,
                                                     double objective);

/// The same of an optimum, with the prices to either side where they differ (one_sided_prices()).
[[nodiscard]] std::vector<ActiveLimit> active_limits_to_either_side(const ScaledProblem& problem,
                                                                    const Found& found);

}  // namespace glissade::optimizer
