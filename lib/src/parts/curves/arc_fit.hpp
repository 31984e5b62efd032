#pragma once

#include "glissade/core/arc_path.hpp"

#include "parts/curves/arc_at.hpp"
#include "parts/curves/circle_pieces.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::parts {

/// A piece of the track beside a stretch that stays what it is, and may reach on into the stretch.
struct KeptEnd {
  ArcAt leg;           ///< where it meets the stretch, along the track
  double reach = 0.0;  ///< how far it may go on, within the tolerance [m]
};

/// A stretch of a track that arcs are to follow. Both ends are kept: their places, or the pieces that lie beside them.
struct Stretch {
  std::size_t first = 0;  ///< of the samples
  std::size_t last = 0;
  std::optional<KeptEnd> before;
  std::optional<KeptEnd> after;
};

/// A chain of arcs along a stretch.
struct ArcChain {
  std::vector<PathVertex> vertices;  ///< the last one ends the chain
  double first_reach = 0.0;          ///< by which the kept piece before goes on [m]
  double last_reach = 0.0;           ///< by which the kept piece after begins earlier [m]
  double deviation =
      0.0;  ///< greatest distance of its arcs from where it is to lie, at the samples; infinite where the chain failed [m]
};

/// Where the joints of a chain lie to begin with.
struct ChainStart {
  std::vector<double>
      knots;  ///< arc lengths, with both ends of the chain; at least two, three between two kept pieces
  std::vector<double> offsets;  ///< of the joints, to the left of the track, one a knot [m]
  double heading = 0.0;         ///< of the first arc; not looked at after a kept piece [rad]
};

/// The chain with given joints that comes closest to a line beside a stretch, as found by moving them across the track.
/// @param middle     how far to the left of the track that line is [m]
/// @param tolerance  the deviation that is enough [m]; the search ends there
[[nodiscard]] ArcChain fit_chain(const TrackSamples& samples, const Stretch& stretch, ChainStart start,
                                 double middle, double tolerance);

}  // namespace glissade::parts
