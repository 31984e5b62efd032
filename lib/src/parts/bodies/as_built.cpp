#include "parts/bodies/as_built.hpp"

#include "parts/bodies/facets.hpp"

namespace glissade::parts {

AsBuiltRide as_told(const FacetRide& found, const Motion& design, std::size_t bends, std::size_t joints) {
  AsBuiltRide ride;
  ride.arrives = found.arrives;
  ride.travel_time = found.time;
  ride.exit_speed = found.speed;
  ride.highest_load = found.highest_load;
  ride.hops = found.hops;
  ride.highest_hop = found.highest_hop;
  ride.stopped = found.stopped;
  ride.design_travel_time = design.travel_time();
  ride.design_exit_speed = design.exit_speed();
  ride.bends = bends;
  ride.joints = joints;
  return ride;
}

AsBuiltRide ride_units(const std::vector<std::shared_ptr<const ArcSpline>>& floors, double joint_step,
                       const Motion& design, const Body& body, double gravity) {
  return as_told(ride_lines(floors, body, gravity, joint_step), design, 0, floors.size() - 1);
}

}  // namespace glissade::parts
