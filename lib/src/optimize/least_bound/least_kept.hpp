#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/problem.hpp"

#include "optimize/conflicts/infeasibility.hpp"
#include "optimize/descent/search.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// A least bound, and which other limits hold it up: by how much of its unit for each unit of theirs.
struct LeastKept {
  double bound = 0.0;  ///< in the user's unit
  std::vector<ActiveLimit> holding;
  Foothold track;  ///< keeps it at the stations of its mesh
};

/// The least bound of a limit that no small change of a track keeps a tighter one than, the other limits being kept: by
/// descents of the violation of that limit alone, on the track's own mesh.
/// @param problem  with a bound of that limit, > 0, which no track keeps
/// @param track    one that keeps the other limits
/// @return none where a descent comes to no end
[[nodiscard]] std::optional<LeastKept> least_kept_near(const Problem& problem, const LimitName& name,
                                                       const Foothold& track, SearchControl& control);

}  // namespace glissade::optimizer
