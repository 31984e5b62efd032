#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

namespace glissade::centerline {

/// @throws InputError if run or drop is not finite, or drop is not positive; names every fault at once
void require_falling(const Endpoints& endpoints);

/// @throws InputError if gravity is not finite or not positive
void require_gravity(double gravity);

/// @return H - mu |L| [m], rounded once: the drop that friction leaves for speed
[[nodiscard]] double drop_beyond_friction(const Endpoints& endpoints, Friction friction);

/// @throws as require_falling; InfeasibleError if drop <= mu |run|: out of reach from rest
void require_reachable_from_rest(const Endpoints& endpoints, Friction friction);

/// @throws InputError if run, drop or entry_speed is not finite, entry_speed is not positive, or both ends are
///         the same; names every fault at once. InfeasibleError if drop <= least_drop(): out of reach
void require_reachable_with_speed(const Endpoints& endpoints, Friction friction, double entry_speed,
                                  double gravity);

}  // namespace glissade::centerline
