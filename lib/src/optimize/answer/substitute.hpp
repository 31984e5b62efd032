#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/problem.hpp"

#include "optimize/conflicts/energy_left.hpp"
#include "optimize/search/simple_tracks.hpp"

// Tracks that take the place of the one that a search found, or for which no search is made.

namespace glissade::optimizer {

/// The unlimited optimum instead, where the search stayed behind it although it keeps every limit: next to the reach limit its
/// flattest stretch asks for more pieces than a mesh has.
/// @return whether it is the answer
[[nodiscard]] bool take_unlimited(const Problem& problem, const OptimizeOptions& options, Optimum& optimum);

/// The ramp instead, where it keeps every limit and the search, which began from it, stayed behind it: that needs something to
/// bend between two straight ends, and tells nearly upright tracks apart by next to nothing.
void take_ramp(const Problem& problem, const OptimizeOptions& options, Optimum& optimum);

/// A track that keeps every limit, and is not said to be the best: feasible_not_converged, without a message.
void answer_with_any(const KeptTrack& kept, Optimum& optimum);

/// Where no search can tell tracks apart, and none is made: the exact optimum where that is known and keeps every limit, else the straight line.
void tell_creeping(const Problem& problem, const OptimizeOptions& options, const Creep& creep,
                   Optimum& optimum);

/// A track that ends where it is asked to. A search ends with the finish met as well as any limit is kept, mostly far better; with a
/// crest that turns within 1e-8 of the track it may stay at the former. Turned and scaled by what it misses the track meets it,
/// and keeps what it kept to as much.
void meet_finish(const Problem& problem, double tolerance, Optimum& optimum);

}  // namespace glissade::optimizer
