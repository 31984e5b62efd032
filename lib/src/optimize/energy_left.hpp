#pragma once

#include "glissade/task/problem.hpp"

#include <optional>

namespace glissade::optimizer {

/// The least speed at the finish [m/s] that the energy equation leaves to any track within the slope angles that the
/// limits allow, however it winds.
///
/// Source: docs/theory.md, reach theorem. With h(q) = 2 g (q - mu) e^(-2 mu atan q) of the slope q = tan zeta the
///   weighted squared speed grows by Int h(q) dx, and no less than by run * E(drop/run), where E is the lower
///   convex envelope of h over the slopes allowed. Contact and radii are not asked for: the true least is higher.
/// @return none where there is no such bound: other bodies than the sliding point, drag, a free finish, slopes that
///         may be as steep as one likes uphill
[[nodiscard]] std::optional<double> least_speed_left(const Problem& problem);

}  // namespace glissade::optimizer
