#pragma once

#include "glissade/optimize/optimize.hpp"

#include <functional>
#include <optional>

namespace glissade::optimizer {

/// Slope angles that leave out the mean slope from start to finish.
///
/// Method: by the mean value theorem every track has that slope somewhere; no search is needed to tell that none keeps
///   such a limit.
/// @param tolerance  by so much a limit may be missed [rad]
/// @param would_do   whether a track is found with another bound; empty: none is told that would do
/// @return the bound in the way, and one that would do; none where the mean slope is allowed, or the finish is free
[[nodiscard]] std::optional<Conflict> beside_mean_slope(
    const Problem& problem, double tolerance, const std::function<bool(const LimitName&, double)>& would_do);

/// A bound that misses the mean slope by less than the tolerance leaves the straight line, but no room in which a search
/// could tell that nothing is better: it becomes the mean slope itself, which does.
/// @param tolerance  as above
[[nodiscard]] Problem with_mean_slope_allowed(Problem problem, double tolerance);

}  // namespace glissade::optimizer
