#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/conflicts/foothold.hpp"

#include <cmath>
#include <optional>

namespace glissade::optimizer {

/// The end of a search that is part of another one.
struct BriefEnd {
  Optimum optimum;
  /// The track as the search has it; none where it came from no mesh.
  std::optional<Foothold> foothold;
  /// Of the search's best track, as the search counts it; infinite where it has none.
  double objective = HUGE_VAL;
};

/// optimize(), for a search that is made of many: where no track keeps the limits, no bounds that would do are looked for. Those
/// take most of the time of such an end, and only the last one of these searches is told of.
/// @param problem  sound, as require_searchable() has it
[[nodiscard]] BriefEnd optimize_briefly(const Problem& problem, const OptimizeOptions& options,
                                        const std::stop_token& stop, const Progress& progress);

/// The same from a track that all but keeps the limits, and from nowhere else: what it ends on is an optimum beside that track, or
/// none is found.
/// @param foothold  of a search of a problem with the same ways past its keep-outs
[[nodiscard]] BriefEnd optimize_from(const Problem& problem, const Foothold& foothold,
                                     const OptimizeOptions& options, const std::stop_token& stop,
                                     const Progress& progress);

}  // namespace glissade::optimizer
