#pragma once

#include "glissade/optimize/optimize.hpp"

#include "optimize/mesh/held_arcs.hpp"
#include "optimize/search/candidate.hpp"
#include "optimize/search/descents.hpp"
#include "referee/judgement.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// The end of a search: the referee judges a track, and what it finds broken between the stations is mended, round by round.
/// Limits are held at the places that it names, or tightened as a whole: the margins of the descents grow.
class Mending {
 public:
  /// @param asked  as the referee is to judge it
  Mending(const Problem& asked, Descents& descents, const Progress& progress)
      : asked_(asked),
        descents_(descents),
        options_(descents.options()),
        control_(descents.control()),
        progress_(progress) {}

  /// Of the tracks on that way the best one counts.
  /// @param candidate  may hold one already, which counts as well
  /// @param ahead      of the track
  /// @param places     at which limits are held beside the stations from the beginning, of the core's length
  void mend(Candidate& candidate, Found found, const Ahead& ahead, const Vector& places = {});
  /// From a track that keeps the limits on its mesh to one that keeps them everywhere, however slow it is: with margins that
  /// begin anew.
  void mend_any(Candidate& candidate, const Mesh& mesh, const Vector& z);

 private:
  void take_if_better(Candidate& candidate, const Found& found, const Ahead& ahead,
                      const CenterlinePtr& track, const referee::Judgement& judgement) const;
  /// Where holding limits at further places made an optimum much dearer: that one, or the optimum on a mesh whose pieces are halved
  /// around these places. A piece of one linear curvature that broke a limit within may keep it at a price that two don't pay.
  [[nodiscard]] Found cheaper_of(const ScaledProblem& problem, Found next, const Found& found,
                                 const Mesh& holding);
  /// A curvature that follows the load more closely where a body lifts off.
  /// @return nothing where that takes no further knots, or no optimum is found with them
  [[nodiscard]] std::optional<Found> following_closely(const ScaledProblem& problem, const Found& found,
                                                       const std::vector<LiftOff>& lifts);
  void tighten(const ScaledProblem& problem, const referee::Judgement& judgement,
               const std::vector<LiftOff>& lifts, int round);
  /// Where the referee found the ride ending, or in the first rounds limits broken the most: holding a limit
  /// exactly there costs nothing, other than tightening it as a whole.
  [[nodiscard]] std::vector<double> places_to_hold(const ScaledProblem& problem,
                                                   const referee::Judgement& judgement, int round) const;

  const Problem& asked_;
  Descents& descents_;
  const OptimizeOptions& options_;
  SearchControl& control_;
  const Progress& progress_;
};

}  // namespace glissade::optimizer
