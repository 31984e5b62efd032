#pragma once

#include "glissade/centerline/centerline.hpp"

#include "parts/arc_fit.hpp"
#include "parts/arc_search.hpp"
#include "parts/circle_pieces.hpp"

namespace glissade::parts {

/// As few arcs with common tangents as were found to keep a band along a stretch.
/// @param stretch  what its kept ends may reach is not looked at
/// @param thorough  whether chains of fewer arcs than are to be expected are worth ten times the time
/// @throws ConvergenceError if no chain is found
[[nodiscard]] ArcChain fewest_arcs(const Centerline& track, const TrackSamples& samples,
                                   const Stretch& stretch, const Band& band, bool thorough);

/// How far a kept piece stays within a band of a stretch beside it.
/// @param step  1 from its start on, -1 from its end back
[[nodiscard]] double reach_of(const TrackSamples& samples, const Stretch& stretch, const ArcAt& leg,
                              const Band& band, int step);

}  // namespace glissade::parts
