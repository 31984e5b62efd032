#pragma once

#include "optimize/descent/search.hpp"

#include <optional>

namespace glissade::optimizer {

/// What knots are moved for, as shares of the objective.
struct KnotMoves {
  /// A jump goes elsewhere where half the way to what stands next would win more; accuracy: of less a twentieth is told, which is
  /// that of a time.
  double worth = 2e-5;
  double at_rest = 1e-5;  ///< a step through all the room would win less; accuracy: ten times that of a time
  double pays = 5e-7;     ///< the least that a step wins; accuracy: half that of a time
  /// Where they promise more than that together they lie far off, and steps would be many: what lies between them is freed at
  /// once (free_spans.hpp). Taste.
  double far = 3e-2;
  bool bends = false;   ///< so do bends without a jump
  int most_steps = 12;  ///< budget
};

/// An optimum among those of neighbouring meshes: knots go to where moving them wins nothing.
///
/// On one mesh the places of the knots are given, and with them those where curvature can jump or bend: the
/// multipliers are those of tracks that can't do so elsewhere. The derivative of the optimum by the place of a knot is
/// that of the Lagrangian, all else fixed; knots close before and behind a jump go together. Meshes are compared by
/// their optima, steps are those of a quasi-Newton method.
/// @param begun  an optimum on its mesh
/// @param tolerance  residual that the optima are to keep
/// @param moves      what counts as well
struct MovedKnots {
  std::optional<Found>
      found;  ///< the best optimum; none where jumps of the curvature lie well, or nothing is won
  double promised =
      0.0;  ///< what jumps of the best one promise to win, to first order, each through all its room
};
[[nodiscard]] MovedKnots with_moved_knots(const ScaledProblem& problem, const Found& begun, double tolerance,
                                          SearchControl& control, const KnotMoves& moves = {});

}  // namespace glissade::optimizer
