#pragma once

#include "glissade/pipeline/solve.hpp"

#include "app/verbosity.hpp"

namespace glissade::app {

/// What no track of a design is shorter than [m]: the straight line, where both ends are given.
[[nodiscard]] double shortest_length_of(const Design& design);

/// The track of a design, with progress, and Ctrl-C met: a search ends with the best track so far.
/// @param time_budget  of a search [s]
/// @throws as solve()
[[nodiscard]] Track searched_track(const Design& design, const Verbosity& verbosity, double time_budget);

/// To be asked once everything that a command tells or writes of the track is there.
/// @throws ConvergenceError if its search ended before it was known to be the best one, exit code 4
void require_searched_through(const Design& design, const Track& track);

}  // namespace glissade::app
