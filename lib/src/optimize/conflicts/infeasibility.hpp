#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/conflicts/foothold.hpp"
#include "optimize/descent/search.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace glissade::optimizer {

/// How a problem with another bound is solved: what is said to be enough has to be. Without its functions nothing is said to be.
struct Resolve {
  /// From the search's own starts; where bends are looked for, from the likely ones alone if there are any, and from these
  /// before all others. It ends after so many evaluations more, whatever is found by then.
  std::function<bool(const Problem&, int most_evaluations, const std::vector<Beginning>& likely)> anew;
  std::function<bool(const Problem&, const Foothold&)> from;
  /// The optimum from its starts, or from tracks that keep the limits; none where there is none.
  std::function<std::optional<Foothold>(const Problem&)> optimum;
};

/// What stands against all limits together, where nothing was found that keeps them.
struct Explanation {
  /// Limits that stand against each other, and what would do; text only where that is certain.
  Conflict conflict;
  bool certain = false;
};

/// Looks for tracks that keep all limits where bends are looked for, from likely beginnings.
/// @return whether one led somewhere
bool has_likely_footing(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
                        SearchControl& control, const std::vector<Beginning>& likely);

/// The same from starts of every kind.
/// @param bends  whether they are looked for
bool has_footing(const Problem& problem, const std::vector<Passages>& passages, const Leads& leads,
                 SearchControl& control, bool bends);

/// The same, and from starts of no kind; where none leads somewhere, what stands in the way.
[[nodiscard]] Explanation explain(const Problem& problem, const std::vector<Passages>& passages,
                                  const Leads& leads, const Resolve& resolve, SearchControl& control);

}  // namespace glissade::optimizer
