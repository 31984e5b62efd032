#pragma once

#include "optimize/scaled_problem.hpp"
#include "optimize/search.hpp"

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
/// @param objective  multiplier of the objective: 1; 0 where a row alone is made least
/// @return those that cost something
[[nodiscard]] std::vector<LeadPrice> lead_prices(const ScaledProblem& problem, const Found& found,
                                                 double objective);

}  // namespace glissade::optimizer
