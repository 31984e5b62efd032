#pragma once

#include "optimize/search/searcher.hpp"

#include <vector>

namespace glissade::optimizer {

/// Tracks that go on to smoother ground which a track found does not come to: a long way down into it and up again may
/// be faster than a short one that never meets it, and no small step leads from one to the other. Each such change of
/// friction is drawn near, the fastest track found for that, and followed back while the change moves to its place.
/// @param found  keeps the limits
/// @return those that keep the limits and still come to that ground
[[nodiscard]] std::vector<Candidate> on_smoother_ground(const Problem& problem, const Passages& passages,
                                                        const Candidate& found,
                                                        const OptimizeOptions& options,
                                                        SearchControl& control, const Progress& progress);

}  // namespace glissade::optimizer
