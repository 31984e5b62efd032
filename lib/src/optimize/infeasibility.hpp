#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/scaled_problem.hpp"
#include "optimize/search.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace glissade::optimizer {

/// What the reach theorem alone forbids (docs/theory.md): from rest, no track leads to a finish whose mean
/// slope is not steeper than the steepest friction angle.
[[nodiscard]] std::optional<Conflict> beyond_reach(const Problem& problem);

/// A track that keeps all limits, to start from.
struct Foothold {
  std::size_t passages = 0;  ///< which of the passages it belongs to
  Mesh mesh;
  Vector z;
};

/// How a problem with another bound is solved: what is said to be enough has to be.
struct Resolve {
  std::function<bool(const Problem&)> anew;  ///< from the search's own starts
  std::function<bool(const Problem&, const Foothold&)> from;
};

/// The end of the search for the least violation of all limits together: tracks that keep them after all, or what
/// stands against them.
struct Explanation {
  std::vector<Foothold> footholds;
  /// Limits that stand against each other, and what would do; text only where that is certain.
  Conflict conflict;
  bool certain = false;
};

/// From starts of every kind.
[[nodiscard]] std::vector<Foothold> footholds_of(const Problem& problem,
                                                 const std::vector<Passages>& passages,
                                                 SearchControl& control);

[[nodiscard]] Explanation explain(const Problem& problem, const std::vector<Passages>& passages,
                                  const Resolve& resolve, SearchControl& control);

}  // namespace glissade::optimizer
