#pragma once

#include "glissade/task/problem.hpp"

#include "optimize/conflicts/infeasibility.hpp"
#include "optimize/descent/search.hpp"

#include <optional>

namespace glissade::optimizer {

/// The least bound of a limit that no small change of a track keeps a tighter one than, the other limits being kept: by
/// descents of the violation of that limit alone, on the track's own mesh.
/// @param problem  with a bound of that limit, > 0, which no track keeps
/// @param track    one that keeps the other limits
/// @return none where a descent comes to no end
[[nodiscard]] std::optional<double> least_kept_near(const Problem& problem, const LimitName& name,
                                                    const Foothold& track, SearchControl& control);

}  // namespace glissade::optimizer
