#pragma once

#include "glissade/pipeline/solve.hpp"

#include <string>

namespace glissade::pipeline {

/// The fastest track within a design's limits, and how the search for it ended, in the design's frame.
/// @param pieces  as in OptimizeOptions
/// @throws LimitsConflict, ConvergenceError, Interrupted as solve()
[[nodiscard]] Optimum search_within_limits(const Design& design, const RunContext& context,
                                           int pieces = OptimizeOptions{}.pieces);

/// Every limit of a design on a given track, in the design's frame; empty without limits.
[[nodiscard]] std::vector<LimitCheck> checked_limits(const Design& design, const Endpoints& endpoints,
                                                     const CenterlinePtr& centerline);

}  // namespace glissade::pipeline
