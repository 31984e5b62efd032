#include "parts/as_built.hpp"

#include "parts/facets.hpp"

namespace glissade::parts {

AsBuiltRide ride_units(const std::vector<std::shared_ptr<const ArcSpline>>& floors, double joint_step,
                       const Motion& design, const Body& body, double gravity) {
  const FacetRide found = ride_lines(floors, body, gravity, joint_step);
  AsBuiltRide ride;
  ride.arrives = found.arrives;
  ride.travel_time = found.time;
  ride.exit_speed = found.speed;
  ride.highest_load = found.highest_load;
  ride.design_travel_time = design.travel_time();
  ride.design_exit_speed = design.exit_speed();
  ride.joints = floors.size() - 1;
  return ride;
}

}  // namespace glissade::parts
