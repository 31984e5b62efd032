#pragma once

#include "glissade/core/arc_path.hpp"

#include "parts/circle_pieces.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// A stretch of a track that arcs are to follow. Both ends are kept, and their tangents where asked for.
struct Stretch {
  std::size_t first = 0;  ///< of the samples
  std::size_t last = 0;
  bool keep_first_tangent = false;
  bool keep_last_tangent = false;
};

/// A chain of arcs along a stretch.
struct ArcChain {
  std::vector<PathVertex> vertices;  ///< the last one ends the chain
  /// Greatest distance of a sample's arc from the middle of the band, weighed by its width; infinite where the chain failed [m].
  double deviation = 0.0;
};

/// The band that the chain is to lie in: round the track moved to its left by `middle`, which falls to 0 at both ends of
/// the stretch together with the band's width.
struct Band {
  double middle = 0.0;  ///< [m]
};

/// @param knots  arc lengths of the joints to begin with, with both ends of the stretch; at least two, three where both
///   tangents are kept
/// @param tolerance  the deviation that is enough [m]; the search ends there, or where it sees that it is out of reach
[[nodiscard]] ArcChain fit_chain(const TrackSamples& samples, const Stretch& stretch,
                                 std::vector<double> knots, const Band& band, double tolerance);

}  // namespace glissade::parts
