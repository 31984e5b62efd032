#pragma once

#include "glissade/centerline/centerline.hpp"

#include "parts/curves/arc_fit.hpp"
#include "parts/curves/arc_search.hpp"
#include "parts/curves/circle_pieces.hpp"

#include <cstddef>

namespace glissade::parts {

/// How few arcs are looked for.
struct FewestSearch {
  std::size_t least = 1;  ///< that a chain may have: no fewer are looked for
  bool thorough =
      false;  ///< whether chains of fewer arcs than are to be expected are worth ten times the time
  /// A chain that is known, from a search that was not thorough; null where there is none.
  const ArcChain* known = nullptr;
};

/// As few arcs with common tangents as were found to keep a band along a stretch.
/// @param stretch  what its kept ends may reach is not looked at
/// @throws ConvergenceError if no chain is found
[[nodiscard]] ArcChain fewest_arcs(const Centerline& track, const TrackSamples& samples,
                                   const Stretch& stretch, const Band& band, const FewestSearch& search);

/// How far a kept piece stays within a band of a stretch beside it.
/// @param step  1 from its start on, -1 from its end back
[[nodiscard]] double reach_of(const TrackSamples& samples, const Stretch& stretch, const ArcAt& leg,
                              const Band& band, int step);

}  // namespace glissade::parts
