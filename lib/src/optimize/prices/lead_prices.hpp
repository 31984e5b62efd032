#pragma once

#include "optimize/descent/search.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <vector>

namespace glissade::optimizer {

/// What a straight end costs at an optimum.
struct LeadPrice {
  LimitName limit;
  double length = 0.0;  ///< [chords]
  double price = 0.0;   ///< scaled objective for each chord by which it is shortened; >= 0
};

/// Straight ends are no rows of the search, but lengths that every row and the objective depend on: their price is the
/// derivative of the Lagrangian by that length, at the optimum's unknowns and multipliers, by central differences.
///
/// Source: A. V. Fiacco, "Introduction to Sensitivity and Stability Analysis in Nonlinear Programming" (1983), 3.4: the
/// derivative of the optimal value by a parameter is that of the Lagrangian.
/// Where friction changes along the track the optimum on a mesh is none of the core's length, which the mesh holds; what the
/// Lagrangian changes by with that is taken off, the core taken to be shorter by what the straight end is longer.
/// Accuracy: that is right to some 2 % of differences of re-solves; where these are not smooth themselves up to 8 % were seen
/// (test_optimize_prices "straight ends cost*" holds eight to 5 %).
/// @param objective  multiplier of the objective: 1; 0 where a row alone is made least
/// @return those that cost something
[[nodiscard]] std::vector<LeadPrice> lead_prices(const ScaledProblem& problem, const Found& found,
                                                 double objective);

}  // namespace glissade::optimizer
