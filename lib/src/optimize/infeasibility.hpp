#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/scaled_problem.hpp"
#include "optimize/search.hpp"

#include <optional>
#include <vector>

namespace glissade::fastest {

/// What the reach theorem alone forbids (docs/theory.md): from rest, no track leads to a finish whose mean
/// slope is not steeper than the steepest friction angle.
[[nodiscard]] std::optional<Conflict> beyond_reach(const Problem& problem);

/// Searches for the least violation of all limits together; where it is not zero, names the limits that hold
/// it up and the smallest change of each one that would do.
[[nodiscard]] std::optional<Conflict> explain(const Problem& problem, const std::vector<Passages>& passages,
                                              SearchControl& control);

}  // namespace glissade::fastest
