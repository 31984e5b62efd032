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

/// A load that every track carries somewhere, whatever its shape: the most of what is known without a search. A body's
/// weight across the slope is carried wherever the track is straight, bends as in a valley, or the body rests.
///
/// Method:
///   1. At the start of a body at rest, or within a lead_in, N = g cos(entry slope).
///   2. At the finish of a track that is concave, or within a lead_out, N >= g cos(exit slope); where it goes up there, it
///      has been level in a valley before, N >= g.
///   3. Between two ends, m the mean slope (of a free finish any that its bounds and the limits on slopes leave): a track
///      that dips below the straight line has slope m and no crest where it is farthest below it (mean value theorem),
///      N >= g cos(m). One that stays above begins no steeper than m, and from rest that asks for as much at the start,
///      see 1. One that is concave stays below.
/// Identity: no track of optimize() has less, a property test.
/// @return [m/s^2]; 0 where nothing is known
[[nodiscard]] double least_load_anywhere(const Problem& problem);

}  // namespace glissade::optimizer
