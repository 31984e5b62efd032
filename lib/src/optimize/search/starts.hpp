#pragma once

#include "glissade/centerline/centerline.hpp"

#include "optimize/discretise/guess.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <optional>
#include <vector>

namespace glissade::optimizer {

/// A straight line to a finish, between its straight ends. @return none where these leave nothing between them
/// @param finish  run and drop [chords]
[[nodiscard]] std::optional<GuessCurve> straight_line(const ScaledProblem& problem, Vec2 finish);

/// The curve of a track that is known. @return none where straight ends leave nothing between them
[[nodiscard]] std::optional<GuessCurve> curve_along(const ScaledProblem& problem, const Centerline& track);

/// Curves to begin the search with, the most promising first; none comes from the user. Lengths are those of
/// the core, without the straight ends.
[[nodiscard]] std::vector<GuessCurve> starts(const ScaledProblem& problem);

/// The fastest track of a body that enters with a speed, and its time: what limits lead away from.
struct FlyingStart {
  GuessCurve curve;
  double travel_time = 0.0;  ///< scaled, without limits and drag
};

/// @return none for one that enters at rest or can't arrive
[[nodiscard]] std::optional<FlyingStart> flying_start(const ScaledProblem& problem);

/// Scaled time along the straight line to where the finish is expected, without drag; infinite where a body stalls on it.
[[nodiscard]] double straight_time(const ScaledProblem& problem);

/// Curves that wind about the straight line, from few bends to many: ways to wear energy down, or to be long.
[[nodiscard]] std::vector<GuessCurve> winding_starts(const ScaledProblem& problem);

/// Staircases between the steepest and the flattest slope that the limits allow, one long ledge first: the body is
/// braked where a steep piece meets a flat one, most of all where it is fast.
[[nodiscard]] std::vector<GuessCurve> stepped_starts(const ScaledProblem& problem);

/// Where the run of the finish is free: to nearer and farther ones than starts() expects, straight and over a crest. Tracks that are to
/// be low have optima at several runs.
[[nodiscard]] std::vector<GuessCurve> starts_to_other_runs(const ScaledProblem& problem);

/// Curves of no kind: those of starts(), flattened and waved by amounts that fill their ranges evenly. What leads to
/// no track from any of them is a contradiction with more right than from the few that are likely.
[[nodiscard]] std::vector<GuessCurve> scattered_starts(const ScaledProblem& problem);

/// The track on which a body of some speed keeps it (docs/theory.md); none without friction, or where the mean slope
/// is not steeper than the friction angle.
[[nodiscard]] std::vector<GuessCurve> constant_speed_starts(const ScaledProblem& problem);

/// Exact least travel time without limits, from rest, without drag, to a point [s]; none where that theory
/// does not apply.
[[nodiscard]] std::optional<double> unlimited_travel_time(const Problem& problem);

}  // namespace glissade::optimizer
