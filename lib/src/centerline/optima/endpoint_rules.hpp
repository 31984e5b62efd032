#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

namespace glissade::centerline {

/// @throws InputError if run or drop is not finite, drop is not positive, or the longer of both is out of
///         kShortestWay to kLongestWay; names every fault at once
void require_falling(const Endpoints& endpoints);

/// @throws InputError if entry_speed is negative or not finite
void require_entry_speed(double entry_speed);

/// @throws InputError if gravity is not within kWeakestGravity to kStrongestGravity
void require_gravity(double gravity);

/// @return whether a body that enters with that speed is as good as at rest: below kRestShare of free fall
[[nodiscard]] bool as_from_rest(const Endpoints& endpoints, double entry_speed, double gravity);

/// @return H - mu |L| [m], rounded once: the drop that friction leaves for speed
[[nodiscard]] double drop_beyond_friction(const Endpoints& endpoints, Friction friction);

/// A drop over a run that is flatter is laid as steep as this: the track is the same to rounding of its length.
inline constexpr double kFlattest = 1e-30;

/// @param drop  beyond friction
/// @return whether a track is a vertical line to rounding of its length, its time and its loss
[[nodiscard]] bool as_vertical(double run, double drop);

/// @throws as require_falling; InfeasibleError if drop <= mu |run|: out of reach from rest
void require_reachable_from_rest(const Endpoints& endpoints, Friction friction);

/// @throws InputError if run, drop or entry_speed is not finite, entry_speed is not positive, both ends are
///         the same, the longer of both is out of its range, or there is too much friction; names every fault at
///         once. InfeasibleError if drop <= least_drop(): out of reach
void require_reachable_with_speed(const Endpoints& endpoints, Friction friction, double entry_speed,
                                  double gravity);

}  // namespace glissade::centerline
