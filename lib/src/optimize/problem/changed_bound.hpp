#pragma once

#include "glissade/task/limit_catalogue.hpp"
#include "glissade/task/problem.hpp"

#include <optional>

namespace glissade::optimizer {

/// The problem with another bound of one limit, all others as they are.
/// @param value  [SI]; of an obstacle its clearance, below 0 where the obstacle itself would have to move; of match_belt
///               the speed along the belt that is still to do
/// @return none for what has no bound of its own: points to pass through, friction, what holds without being asked
///         for
[[nodiscard]] std::optional<Problem> with_bound(const Problem& problem, const LimitName& limit, double value);

}  // namespace glissade::optimizer
