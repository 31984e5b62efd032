#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/problem.hpp"

#include <optional>

namespace glissade::optimizer {

/// What the reach theorem alone forbids (docs/theory.md): from rest, no track leads to a finish whose mean
/// slope is not steeper than the steepest friction angle; with an entry speed, none that is too slow for the way.
/// @return none where the theorem allows a track, or says nothing: a free finish, a wind that drives the body
[[nodiscard]] std::optional<Conflict> beyond_reach(const Problem& problem);

}  // namespace glissade::optimizer
