#pragma once

#include "glissade/centerline/centerline.hpp"

#include "parts/arc_fit.hpp"
#include "parts/circle_pieces.hpp"

#include <cstddef>
#include <optional>

namespace glissade::parts {

/// Where a chain may lie beside the track, its ends on the track.
struct Band {
  double left = 0.0;   ///< by how much to the left of it at most [m]; > 0
  double right = 0.0;  ///< to the right [m]; > 0

  [[nodiscard]] double half_width() const { return 0.5 * (left + right); }
  [[nodiscard]] Band scaled(double factor) const { return {factor * left, factor * right}; }
};

/// A chain within a band, and where its joints lie as seen from the track.
struct FoundChain {
  ArcChain chain;
  ChainStart joints;
  std::size_t arcs = 0;
};

/// A chain of few arcs within a band, by dynamic programming over the places and headings that some number of arcs can
/// reach.
/// @param stretch  what its kept ends may reach is within the band
/// @param steps  places for a joint along the longest piece that one circle passes: the chain has up to half an arc in
///   as many more than needed
/// @return none where no chain was met
[[nodiscard]] std::optional<FoundChain> search_chain(const Centerline& track, const TrackSamples& samples,
                                                     const Stretch& stretch, const Band& band,
                                                     std::size_t steps);

}  // namespace glissade::parts
