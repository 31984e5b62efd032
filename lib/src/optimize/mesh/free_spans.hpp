#pragma once

#include "optimize/descent/search.hpp"

#include <optional>

namespace glissade::optimizer {

/// Whether spans of a problem's track can have lengths of their own: no friction changes and no limit begins at a given arc
/// length, and no law asks how far a ride has come.
[[nodiscard]] bool can_free_spans(const ScaledProblem& problem);

/// A better optimum whose jumps and bends of the curvature may lie far from where those of the one known do.
///
/// On one mesh the places of jumps are given. Here the lengths of what lies between them are unknowns of the program itself
/// (Layout): jumps of the curvature first, then its bends too, where it may come to jump. The optimum is told on a mesh of one
/// length again, with short ramps for the jumps; that is the result. As each span may become no shorter or longer than by
/// constant factors, it is done again where it pays.
/// @param begun      an optimum on its mesh
/// @param tolerance  residual that the optimum is to keep
/// @return none where nothing is won
[[nodiscard]] std::optional<Found> with_free_spans(const ScaledProblem& problem, const Found& begun,
                                                   double tolerance, SearchControl& control);

}  // namespace glissade::optimizer
