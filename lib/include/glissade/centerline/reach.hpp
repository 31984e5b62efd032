#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

namespace glissade {

/// Who can arrive at all, whatever the shape of the track, without drag: the reach theorem.
///
/// Source: docs/theory.md, reach theorem, (R5): a finish at distance l (straight) and drop H is reached if and
///   only if H + (1 + sin(delta)) v0^2/(2 g) > l sin(delta); from rest, if the mean slope exceeds delta.
/// Identity: least_entry_speed and least_drop are inverse to each other.

/// @param endpoints  run [m], finite, any sign; drop [m], finite, any sign
/// @param gravity    [m/s^2]; kWeakestGravity to kStrongestGravity
/// @throws InputError if a number is outside its stated range
/// @return the entry speed at which a body would come to rest at the finish on the best track there is [m/s];
///         more is needed to arrive. 0 where it arrives from rest, or but for rounding would
[[nodiscard]] double least_entry_speed(const Endpoints& endpoints, Friction friction,
                                       double gravity = kDefaultGravity);

/// @param run          [m]; finite, any sign
/// @param entry_speed  v0 [m/s]; finite, >= 0
/// @param gravity      [m/s^2]; kWeakestGravity to kStrongestGravity
/// @throws InputError if a number is outside its stated range
/// @return the drop that a finish at that run must exceed [m]; negative above the start, -infinity if the body could
///         climb without bound
[[nodiscard]] double least_drop(double run, Friction friction, double entry_speed,
                                double gravity = kDefaultGravity);

/// @param entry_speed  v0 [m/s]; finite, >= 0
/// @throws InputError as least_drop(), or if the drop is not finite
/// @return true if some track takes a body to the finish
[[nodiscard]] bool can_arrive(const Endpoints& endpoints, Friction friction, double entry_speed,
                              double gravity = kDefaultGravity);

}  // namespace glissade
