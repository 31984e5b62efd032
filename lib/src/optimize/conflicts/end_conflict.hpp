#pragma once

#include "glissade/optimize/optimize.hpp"

#include <functional>
#include <optional>

namespace glissade::optimizer {

/// A start or a finish that lies too close to obstacles for the envelope, whatever way the track leads there.
///
/// Method: at an end the envelope holds at least the normal of the centerline, from the underside to the top,
///   and its direction is the only thing that a track may choose. All slope angles that the limits allow are
///   tried, some thousand of them; none keeps the clearances by so much that one in between could.
/// @param would_do  whether a track is found with another clearance; empty: none is told that would do
/// @return the obstacles that no direction keeps clear of, and what would do; none if both ends have room
[[nodiscard]] std::optional<Conflict> too_close_at_an_end(
    const Problem& problem, const std::function<bool(const LimitName&, double)>& would_do);

/// A start or a finish on the side of a keep-out that is not to be passed: no track ends there.
/// @return that keep-out; none if both ends lie where they may
[[nodiscard]] std::optional<Conflict> on_other_side_at_an_end(const Problem& problem);

}  // namespace glissade::optimizer
