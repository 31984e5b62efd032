#pragma once

#include "parts/curves/arc_fit.hpp"
#include "parts/curves/arc_search.hpp"
#include "parts/curves/circle_pieces.hpp"

#include <cstddef>

namespace glissade::parts {

/// How far along a stretch one arc can go that leaves a kept piece along its tangent.
/// @param band      where it may lie
/// @param backward  whether it leaves the kept piece after the stretch, towards its start, instead of the one before;
///                  that piece is there
/// @return the last sample that some such arc, from wherever the kept piece is within the band, passes within it. No arc
///   passes the one after: for each place that it could leave from there are samples that ask for other curvatures.
[[nodiscard]] std::size_t farthest_from_kept(const TrackSamples& samples, const Stretch& stretch,
                                             const Band& band, bool backward);

/// Whether one arc that touches both pieces beside a stretch may keep the band.
/// @return true unless it is certain that none does
[[nodiscard]] bool one_arc_may_do(const TrackSamples& samples, const Stretch& stretch, const Band& band);

/// The fewest arcs that a stretch takes, whatever way they are joined with each other, so long as they leave the kept
/// pieces beside it along their tangents; 0 where these may meet each other, or the end of the track.
[[nodiscard]] std::size_t least_arcs(const TrackSamples& samples, const Stretch& stretch, const Band& band);

}  // namespace glissade::parts
