#pragma once

#include "optimize/problem/scaled_problem.hpp"

#include <vector>

namespace glissade::optimizer {

/// @return every combination of sides for the keep-outs that leave it open, up to a cap of 16
[[nodiscard]] std::vector<Passages> all_passages(const Limits& limits);

}  // namespace glissade::optimizer
