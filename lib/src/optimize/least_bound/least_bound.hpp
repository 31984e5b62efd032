#pragma once

#include "glissade/optimize/optimize.hpp"

namespace glissade::optimizer {

/// The tightest bound of one limit at which a given exit speed is still reached: least_load, least_curvature_rate.
///
/// Method: the greatest exit speed within a bound grows with it, and its derivative is the price of the bound: Newton
///   steps between a bound that is too tight and one that is loose find where it is the speed wanted. They are taken in
///   the length of the bends that the bound allows, in which the speed is nearly linear. Each step is a search of its
///   own. Prices are those of the last search over that of the bound.
///   A search that comes to no end proves nothing of a bound: it is looked at a second way, by the least travel time with
///   the speed as a limit, and left open if that comes to no end either. Only a bound below which the fastest track is
///   too slow, or which no track keeps, is called the least; its neighbour below is looked at once more.
/// @param problem  its objective is_least_bound(); sound, as require_searchable() has it
[[nodiscard]] Optimum least_bound(const Problem& problem, const OptimizeOptions& options,
                                  const std::stop_token& stop, const Progress& progress);

}  // namespace glissade::optimizer
