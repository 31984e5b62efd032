#pragma once

#include "glissade/core/vec.hpp"

#include "optimize/algebra/dense.hpp"
#include "optimize/discretise/transcription.hpp"

#include <cstddef>
#include <vector>

namespace glissade::optimizer {

struct State;

// Distances of points from the track, at their feet on it, and of its stations from edges.

/// Signed distance of a corner from the track at its foot: positive where the corner lies on the side that
/// `side` calls forbidden; unsigned beyond the ends of the track.
[[nodiscard]] double corner_distance(const Foot& foot, Vec2 corner, double side);

/// What a distance at a foot weighs the stations beside it with.
void add_foot_weights(const Foot& foot, double factor, StationWeights& weights);

/// Unit vector square to an edge, towards the forbidden side.
[[nodiscard]] Vec2 edge_normal(Vec2 from, Vec2 to, double side);

/// Whether an edge of a chain tells how far a point lies from what the chain bounds. A point on its free side
/// is as far from it as from the line through it where it lies beside the edge; one behind that line lies within
/// only over the edge's own runs: elsewhere, in a gully or beyond a cliff, other edges stand before this one.
[[nodiscard]] bool concerns(Vec2 point, Vec2 from, Vec2 to, double side);

/// Points in their order along a track, asked for edge after edge which of them it concerns.
class ConcernedPoints {
 public:
  explicit ConcernedPoints(std::vector<Vec2> points);

  /// Every one that concerns() has for an edge, in their order.
  /// @param found  emptied first
  void of_edge(Vec2 from, Vec2 to, double side, std::vector<std::size_t>& found) const;

 private:
  /// Some points that follow each other lie within a circle.
  struct Block {
    std::size_t first = 0;
    std::size_t end = 0;
    Vec2 centre;
    double radius = 0.0;
  };
  std::vector<Vec2> points_;
  std::vector<Block> blocks_;
};

/// @return curvature at a foot
[[nodiscard]] double curvature_at(const Transcription& track, const Vector& z, const Foot& foot);

/// Second derivative of a corner's distance at its foot, which slides along the track.
void add_foot_terms(const Transcription& track, const State& state, const Foot& foot, double distance,
                    double side, double factor, Matrix& hessian);

}  // namespace glissade::optimizer
