#pragma once

#include "glissade/core/arc_path.hpp"

#include "parts/circle_pieces.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::parts {

/// One arc, or straight line, by a place on it and what it does there.
struct ArcAt {
  Vec2 from;
  double heading = 0.0;
  double curvature = 0.0;

  /// @return signed distance of a point from the arc's circle, positive to the left
  [[nodiscard]] double distance(Vec2 point) const;
  /// @return the same arc a length further on
  [[nodiscard]] ArcAt after(double length) const;
};

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
  /// Greatest distance of a sample's arc from the middle of the band, weighed by its width; infinite where the chain failed [m].
  double deviation = 0.0;
};

/// The band that the chain is to lie in: round the track moved to its left by `middle`, which falls to 0 at both ends of
/// the stretch together with the band's width.
struct Band {
  double middle = 0.0;  ///< [m]
};

/// @param knots  arc lengths of the joints to begin with, with both ends of the chain; at least two, three where it lies
///   between two kept pieces
/// @param tolerance  the deviation that is enough [m]; the search ends there, or where it sees that it is out of reach
[[nodiscard]] ArcChain fit_chain(const TrackSamples& samples, const Stretch& stretch,
                                 std::vector<double> knots, const Band& band, double tolerance);

/// The one arc that is tangent to both kept pieces beside a stretch, its joints where it comes closest.
/// @param stretch  between two kept pieces that reach on
/// @return infinite deviation where there is none within their reach
[[nodiscard]] ArcChain tangent_arc(const TrackSamples& samples, const Stretch& stretch);

}  // namespace glissade::parts
