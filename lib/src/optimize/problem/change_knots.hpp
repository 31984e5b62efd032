#pragma once

#include "optimize/problem/scaled_problem.hpp"

#include <vector>

namespace glissade::optimizer {

/// The changes of friction within a core of some length, in order.
[[nodiscard]] std::vector<ChangeKnots> change_knots(const ScaledProblem& problem, double core_length);

/// Knots with those of the changes, in place of others that are as close to them.
[[nodiscard]] Vector with_change_knots(const Vector& knots, const std::vector<ChangeKnots>& changes);

}  // namespace glissade::optimizer
