#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/scaled_problem.hpp"
#include "optimize/search.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// What the reach theorem alone forbids (docs/theory.md): from rest, no track leads to a finish whose mean
/// slope is not steeper than the steepest friction angle.
[[nodiscard]] std::optional<Conflict> beyond_reach(const Problem& problem);

/// The end of the search for the least violation of all limits together.
struct Explanation {
  std::optional<Conflict>
      conflict;  ///< where some violation is left: who holds it up, and what each would take
  /// Where some violation is left and no conflict is confirmed: the limits that the closest track breaks.
  std::vector<std::string> nearly;
  std::size_t passages = 0;  ///< otherwise a track that keeps all limits, and the passages it belongs to
  Mesh mesh;
  Vector z;
};
[[nodiscard]] Explanation explain(const Problem& problem, const std::vector<Passages>& passages,
                                  SearchControl& control);

}  // namespace glissade::optimizer
