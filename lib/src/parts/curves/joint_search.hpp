#pragma once

#include "parts/curves/arc_fit.hpp"
#include "parts/curves/arc_search.hpp"
#include "parts/curves/circle_pieces.hpp"

#include <cstddef>
#include <optional>

namespace glissade::parts {

/// Where the joints of a chain of few arcs lie, as seen from the track: dynamic programming as search_chain() does it,
/// to first order in the width of the band, which costs a fifth. Chains are true once fit_chain() has closed in on them.
/// @param stretch  what its kept ends may reach is within the band
/// @param steps  places for a joint along the longest piece that one circle passes
/// @return none where no chain was met
[[nodiscard]] std::optional<ChainStart> search_joints(const TrackSamples& samples, const Stretch& stretch,
                                                      const Band& band, std::size_t steps);

}  // namespace glissade::parts
