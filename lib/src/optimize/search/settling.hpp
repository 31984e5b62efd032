#pragma once

#include "optimize/descent/search.hpp"
#include "optimize/problem/scaled_problem.hpp"
#include "optimize/search/candidate.hpp"
#include "optimize/search/descents.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// A track that has come to rest on its finest mesh.
struct Settled {
  Found found;
  /// A better optimum on a mesh whose jumps of the curvature lie where they belong; none where they lie there. What it wins a
  /// limit between its stations may take again, or the last digits.
  std::optional<Found> moved;
  Ahead ahead;                    ///< of both
  std::vector<Found> on_the_way;  ///< what it was in turn; where time is over the best of these counts
};

/// What becomes of a track of one problem on the finest mesh of pieces: knots go where they are needed, and the curvature
/// follows what binds. Each step leads from optimum to optimum, and leaves a track as it is where the next one is none.
class Settling {
 public:
  Settling(const ScaledProblem& problem, Descents& descents, Promises promises = Promises::left)
      : problem_(problem),
        descents_(descents),
        options_(descents.options()),
        control_(descents.control()),
        promises_(promises) {}

  /// All the steps.
  [[nodiscard]] Settled settled(Found found);

  /// The same track with caps on the speed held where it exceeds them between its stations. It comes before jumps and bends are
  /// moved: they would go where stations miss what is exceeded.
  [[nodiscard]] Found held_between(Found found);
  /// The same with a curvature that follows the limits on loads and the caps on the speed which it lies at.
  [[nodiscard]] Found followed(Found found);

 private:
  /// The same, jumps of the curvature that lie far from where they belong brought there.
  [[nodiscard]] Found with_far_jumps_moved(Found found);
  /// The same with bends at the ends that are too short for the usual pieces to tell. Where exit speed counts a last one over a crest,
  /// where the track carries less, may win it; the centre of a body that is high has a shorter way over bends at either end.
  [[nodiscard]] Found bent_at_ends(Found found);
  /// Pieces are halved where a finer mesh has much left to win.
  /// @param ahead  of the last mesh looked at, whether the track stays on it or not
  [[nodiscard]] Found halved(Found found, Ahead& ahead);
  /// The same with jumps of the curvature where they belong, in rounds: Settled::moved.
  /// @param track  with tighter corners and shorter ramps afterwards
  [[nodiscard]] std::optional<Found> with_jumps_at_rest(Settled& track);
  /// The same with shorter ramps for jumps of the curvature, where that is better.
  [[nodiscard]] Found with_short_ramps(Found found);
  /// The same with corners ever tighter where no radius is asked for, as long as that pays: how tight they are would be up to the mesh.
  [[nodiscard]] Found with_tight_corners(Found found);

  const ScaledProblem& problem_;
  Descents& descents_;
  const OptimizeOptions& options_;
  SearchControl& control_;
  Promises promises_;
};

}  // namespace glissade::optimizer
