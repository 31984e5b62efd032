#pragma once

#include "optimize/descent/search.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <vector>

namespace glissade::optimizer {

/// What a bound is worth to either side, scaled objective for each unit of the bound [SI].
struct OneSidedPrice {
  LimitName limit;
  double relaxing = 0.0;    ///< >= 0: what is won
  double tightening = 0.0;  ///< > relaxing: what it costs; infinite where no track keeps a tighter bound
};

/// The limits whose bound lies just where another one begins to bind: two rows that hold the same of the track, or more
/// than it can give way to. The multipliers there are not unique, and the least objective over the bound has a kink:
/// relaxing the bound wins the least multiplier of all that meet the first-order conditions, tightening it costs the
/// greatest. Both are those of the quadratic program at the optimum with the bound moved a little to either side. Of a
/// value to be met exactly, relaxing is the way that wins; where neither does, tightening the one that costs more.
///
/// Source: A. V. Fiacco and Y. Ishizuka, "Sensitivity and stability analysis for nonlinear programming", Annals of
/// Operations Research 27 (1990) 215-235: directional derivatives of the optimal value.
/// @return those with a kink alone
[[nodiscard]] std::vector<OneSidedPrice> one_sided_prices(const ScaledProblem& problem, const Found& found);

}  // namespace glissade::optimizer
