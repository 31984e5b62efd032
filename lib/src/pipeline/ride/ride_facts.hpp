#pragma once

#include "glissade/motion/motion.hpp"
#include "glissade/pipeline/track.hpp"
#include "glissade/trades/rules.hpp"

#include "pipeline/ride/extremes.hpp"

#include <string>
#include <vector>

namespace glissade::pipeline {

/// What rules ask of one ride, from the start of a track or from a gate.
struct RideFacts {
  std::string place;  ///< which ride, for people: "low friction", "gate 49, slow"; may be empty
  RideEnd end = RideEnd::arrived;
  double ended_at = 0.0;     ///< arc length from the start of the track [m], as of the extremes
  double travel_time = 0.0;  ///< [s]; of a ride that arrives
  double exit_speed = 0.0;   ///< [m/s]; of a ride that arrives
  Extreme highest_speed;
  Extreme highest_load;
  Extreme lowest_load;
  Extreme highest_radial;

  [[nodiscard]] bool arrived() const { return end == RideEnd::arrived; }
};

[[nodiscard]] RideFacts facts_of(const GateRide& ride, std::string place);

/// @return which ride of a table, for people: "gate 49", "gate 49, slow"
[[nodiscard]] std::string place_of(const GateTable& table, const GateCondition& condition,
                                   const GateRide& ride);

/// @return the rides from the start of a track at every friction of its range
[[nodiscard]] std::vector<RideFacts> rides_from_start(const Track& track);
/// @return those from every gate in every condition and at every friction of a range, and rides_from_start()
[[nodiscard]] std::vector<RideFacts> all_rides(const Track& track);

/// Adds one ride to the quantities that every track has.
void measure_ride(const RideFacts& ride, Measurements& measurements);
/// The speed that a ride comes to the finish with: 0 of one that stalls, nothing of one that ends otherwise.
void see_exit_speed(const RideFacts& ride, Extremes& speeds);
/// What Extremes::lack() takes of a ride that does not arrive, or not even get onto its track.
/// @param place     which ride; may be empty
/// @param end       not arrived
/// @param ended_at  arc length [m]
/// @return "rides that arrive (high friction: stalled at 6.67 m)"
[[nodiscard]] std::string missing_arrival(const std::string& place, RideEnd end, double ended_at);
[[nodiscard]] std::string missing_arrival(const RideFacts& ride);

}  // namespace glissade::pipeline
