#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/descent/search.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// The limits that carry multipliers, and straight ends that cost something, each with where it binds and its price, in
/// the order of their keys.
/// @param objective  multiplier of the objective: 1; 0 where a row alone is made least
[[nodiscard]] std::vector<ActiveLimit> active_limits(const ScaledProblem& problem, const Found& found,
                                                     double objective);

/// The same of an optimum, from meshes fine enough for prices, with those to either side where they differ
/// (one_sided_prices()).
///
/// A jump that lies a little beside its knots costs next to nothing, but its first order shows in the prices: here knots
/// go to where moving them wins nothing, and pieces next to jumps and to straight ends are halved a few times, with ripples
/// that nobody should build. Where a mesh whose every piece is halved has other prices, so are all pieces, until prices
/// stay. Those that still change alike from mesh to mesh are continued (by Aitken), and told with how far that is.
/// @param ahead  multipliers of each limit on such a mesh (Outlook::by_limit); none where it was not looked at
struct PricedLimits {
  std::vector<ActiveLimit> limits;
  double length = 0.0;  ///< of the track that their places are on [m]: on a finer mesh it is another one
  /// An optimum that is to be the answer instead: with moved knots, or on the finest of these meshes where that wins more
  /// than a time's accuracy.
  std::optional<Found> better;
  bool is_finest = false;  ///< the better one is that on the finest mesh
  double least = 0.0;      ///< objective of the best optimum on any of these meshes, to some 1e-9
  double rest = 0.0;       ///< by which meshes finer still would be better yet, at first order
  /// By which the optimum on a mesh of all pieces halved is better, where nothing jumps and one was found: known, not promised.
  std::optional<double> halved_wins;
};
[[nodiscard]] PricedLimits priced_limits(const ScaledProblem& problem, const Found& found,
                                         const Vector& ahead, const OptimizeOptions& options,
                                         SearchControl& control);

/// Prices at one optimum, from those at another close to it, on the same problem: changed by as much as the multipliers.
void carry_over(const ScaledProblem& problem, const Found& from, const Found& to,
                std::vector<ActiveLimit>& limits);

}  // namespace glissade::optimizer
