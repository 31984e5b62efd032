#include "glissade/centerline/fastest_track.hpp"

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/flying_start_brachistochrone.hpp"

#include "centerline/optima/endpoint_rules.hpp"

#include <memory>

namespace glissade {

FastestTrack fastest_track(const Endpoints& endpoints, Friction friction, double entry_speed,
                           double gravity) {
  centerline::require_entry_speed(entry_speed);
  if (entry_speed == 0.0) {
    const auto track = std::make_shared<const CoulombBrachistochrone>(endpoints, friction, gravity);
    return {track, track->solution().travel_time, track->solution().exit_speed};
  }
  const auto track =
      std::make_shared<const FlyingStartBrachistochrone>(endpoints, friction, entry_speed, gravity);
  return {track, track->solution().travel_time, track->solution().exit_speed};
}

double fastest_travel_time(const Endpoints& endpoints, Friction friction, double entry_speed,
                           double gravity) {
  centerline::require_entry_speed(entry_speed);
  if (entry_speed == 0.0) return solve_coulomb_brachistochrone(endpoints, friction, gravity).travel_time;
  return solve_flying_start(endpoints, friction, entry_speed, gravity).travel_time;
}

}  // namespace glissade
