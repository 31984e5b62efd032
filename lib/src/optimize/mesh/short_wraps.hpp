#pragma once

#include "optimize/mesh/switches.hpp"

#include <vector>

namespace glissade::optimizer {

/// Where a track runs round a corner of an obstacle for less than a few pieces.
///
/// It bends there about the corner: with the distance that is allowed as radius. Between two knots such an arc is not
/// seen, and the track found bends as much as two pieces let it. How long the arc is follows from by how much the
/// track turns there more than before and behind.
/// @return two switches for each, of which the blurred stretches are what knots do not follow yet; in order
[[nodiscard]] std::vector<Switch> short_wraps(const ScaledProblem& problem, const Found& found);

}  // namespace glissade::optimizer
