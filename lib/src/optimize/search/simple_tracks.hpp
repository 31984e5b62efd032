#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/task/problem.hpp"

#include "referee/judgement.hpp"

#include <optional>

namespace glissade::optimizer {

/// A track that keeps every limit, and what the referee says of it.
struct KeptTrack {
  CenterlinePtr track;
  referee::Judgement judgement;
};

/// @param tolerance  of limits, in scales
/// @return none where the referee finds a limit broken, or the body does not arrive
[[nodiscard]] std::optional<KeptTrack> kept_track(const Problem& problem, CenterlinePtr track,
                                                  double tolerance);

/// A track that takes no search: a straight line, or two with a bend between them, an arc or one whose curvature grows and fades.
///
/// Slopes of the lines are those that limits leave, in a few steps; the bend is as wide as the lines let it be, or half of that.
/// Where the end is free both ways the first line is as long as the lowest exit speed asks for. Each is held against all limits.
/// To a free finish also the straight lines of a StraightFan.
/// Cost: at most some 150 rides of a track of four pieces, and 513 of a line to a free finish, tens of milliseconds.
/// @return of those that keep every limit the best one
[[nodiscard]] std::optional<KeptTrack> simple_track(const Problem& problem, double tolerance);

}  // namespace glissade::optimizer
