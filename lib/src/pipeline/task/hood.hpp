#pragma once

#include "glissade/pipeline/solve.hpp"

#include <optional>
#include <vector>

namespace glissade::pipeline {

/// @throws InputError if something of the hood is still to be chosen
[[nodiscard]] HoodShape shape_of(const HoodDesign& hood);

/// The fall from the feed to what it meets first, the hood or the start; the pulley is seen from there.
[[nodiscard]] FeedFall first_fall(const Design& design);

/// A design whose hood is known.
struct SettledDesign {
  Design design;
  std::optional<EarlyHood> hood_search =
      {};  ///< none where the hood was given, or its search came to its end
  std::optional<Optimum> rough =
      {};  ///< below the hood that a search chose, of fewer pieces, where the track was searched for
};

/// The design with the hood of the best transfer: what a search may choose of it is chosen together with the track
/// below, by the design's objective over both.
/// @return the design itself where there is nothing to choose
/// @throws InfeasibleError, ConvergenceError, Interrupted as solve(), if no choice makes a track, or none was found in time
[[nodiscard]] SettledDesign settled(const Design& design, const RunContext& context);

/// Why a stream does not pass the hood of a design at one of its frictions, or how the hood is in the way.
/// @return none if it does, or if there is no hood
[[nodiscard]] std::optional<Issue> hood_problem(const Design& design);

/// The underside of a design's hood, and where it lies.
struct PlacedHood {
  CenterlinePtr arc;  ///< from where the feed meets it, at (0, 0), to its lower edge
  Vec2 entry;         ///< where that is, seen from the start of the track: run and drop [m]
};
/// @param passage  at the nominal friction
[[nodiscard]] PlacedHood placed_hood(const Design& design, const HoodPassage& passage);

/// The underside turned over, a valley: its floor and walls are those of the hood upside down.
[[nodiscard]] CenterlinePtr turned_over(const HoodShape& hood, const Landing& feed);

}  // namespace glissade::pipeline
