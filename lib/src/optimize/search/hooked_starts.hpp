#pragma once

#include "optimize/discretise/guess.hpp"
#include "optimize/problem/scaled_problem.hpp"

#include <vector>

namespace glissade::optimizer {

/// Under a cap on the speed far below what the drop gives the fastest tracks are made of three kinds of pieces: falls, which
/// press as little as allowed, up to the cap; rides at the cap, whose curvature rubs off what the slope gives
/// (docs/theory.md: the constant-speed track); and hooks, the tightest bends upwards that the limits allow, which rub off
/// speed at next to no length, and end in a fall once more. Of such tracks with one, two and more hooks, each time the
/// fastest one that leads to the finish and keeps the limits on slope angle, speed, curvature and load, at every friction
/// of the range, as a point that slides has it.
/// @return the fastest first, other numbers of hooks behind it; none without a cap on the speed, for a finish that is no
///         point, where the rate of curvature is limited, or where no such track leads to the finish
[[nodiscard]] std::vector<GuessCurve> hooked_starts(const ScaledProblem& problem);

}  // namespace glissade::optimizer
