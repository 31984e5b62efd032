#pragma once

#include "optimize/descent/search.hpp"

#include <cstddef>
#include <vector>

namespace glissade::optimizer {

/// Knots that move together: one where curvature bends, or those around a jump of it.
struct KnotGroup {
  std::size_t first = 0;
  std::size_t last = 0;
  [[nodiscard]] bool is_bend() const { return first == last; }
};

/// Those of a track that may move, in order: not the ends, nor what stands at a change of friction, nor knots at which
/// curvature goes on in a line.
[[nodiscard]] std::vector<KnotGroup> knot_groups_of(const Found& found);

}  // namespace glissade::optimizer
