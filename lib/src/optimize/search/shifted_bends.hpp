#pragma once

#include "optimize/descent/search.hpp"
#include "optimize/mesh/refinement.hpp"
#include "optimize/mesh/switches.hpp"

#include <vector>

namespace glissade::optimizer {

/// Stretches along which a cap on the speed binds, in shares of the core; those hardly apart are one. Between two of them
/// the track bends.
[[nodiscard]] std::vector<Span> stretches_at_cap(const ScaledProblem& problem, const Found& found);

/// The track with a bend moved along, into the stretch before it or behind it: a part of that changes places with the bend,
/// knots and all. Both are ridden at the same speed as before, and the whole leads to the same place but for what the slope
/// differs by along the stretches: a beginning close to the limits.
/// @param before,behind  stretches_at_cap() on either side of the bend
/// @param share          in (-1, 1): how much of the one behind, or where negative of the one before
[[nodiscard]] MeshTrack with_shifted_bend(const Found& found, Span before, Span behind, double share);

}  // namespace glissade::optimizer
