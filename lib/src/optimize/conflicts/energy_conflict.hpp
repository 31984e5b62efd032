#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/problem.hpp"

#include <optional>
#include <string>

namespace glissade::optimizer {

/// A lowest speed that no track can reach, whatever its shape, and why.
struct OutOfEnergy {
  StatedLimit limit;
  std::string why;
};

/// @return none where the bounds of most_speed_left() and most_speed_after() leave every lowest speed
[[nodiscard]] std::optional<OutOfEnergy> out_of_energy(const Problem& problem);

/// Whether no track can be as slow as a limit asks, however it winds.
/// @return why; none where least_speed_left() allows every highest speed
[[nodiscard]] std::optional<std::string> too_fast(const Problem& problem);

}  // namespace glissade::optimizer
