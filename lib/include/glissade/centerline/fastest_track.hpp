#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/units.hpp"

namespace glissade {

/// The fastest track there is between two points, by its closed form, from rest or with an entry speed.
struct FastestTrack {
  CenterlinePtr centerline;  ///< CoulombBrachistochrone from rest, else FlyingStartBrachistochrone
  double travel_time = 0.0;  ///< [s]
  double exit_speed = 0.0;   ///< [m/s]
};

/// @param entry_speed  [m/s]; finite, >= 0, however small or large
/// @throws InputError if entry_speed is negative or not finite; else as solve_coulomb_brachistochrone from rest, as
///         solve_flying_start with an entry speed
[[nodiscard]] FastestTrack fastest_track(const Endpoints& endpoints, Friction friction, double entry_speed,
                                         double gravity = kDefaultGravity);

/// The same without the curve. Allocates nothing unless it throws.
/// @throws as fastest_track
[[nodiscard]] double fastest_travel_time(const Endpoints& endpoints, Friction friction, double entry_speed,
                                         double gravity = kDefaultGravity);

}  // namespace glissade
