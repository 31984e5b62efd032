#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/problem.hpp"

#include "optimize/answer/course.hpp"
#include "optimize/conflicts/infeasibility.hpp"
#include "optimize/descent/search.hpp"

namespace glissade::optimizer {

/// Tells of the best track that keeps every limit: what it reaches, which limits hold it back, what each costs, what finer meshes
/// would win. The course goes on to a better track where prices come upon one.
/// @pre course.kept()
void tell_track(Course& course, const OptimizeOptions& options, SearchControl& control,
                const Progress& progress, OptimizeReport& report);

/// Tells how a search that came to a track ended, in a status and a sentence.
/// @param optimum   with the track, and the residual of tell_track() or of what took its place
/// @param is_exact  the track is the optimum without limits
void tell_end(const Problem& problem, const OptimizeOptions& options, const Course& course, bool out_of_time,
              bool is_exact, Optimum& optimum);

/// Tells why there is no track.
/// @param certain  whether the conflict was confirmed: infeasible, else no track was found
/// @param stopped  before that could be told
void tell_none(Conflict conflict, bool certain, bool stopped, OptimizeReport& report);

}  // namespace glissade::optimizer
