#include "pipeline/ride/ride_facts.hpp"

#include "glissade/core/number_text.hpp"

#include <limits>
#include <utility>

namespace glissade::pipeline {
namespace {

RideFacts facts_along(const Motion& motion, std::string place) {
  RideFacts facts;
  facts.place = std::move(place);
  facts.end = ride_end(motion);
  facts.ended_at = motion.distance();
  facts.travel_time = motion.travel_time();
  facts.exit_speed = motion.exit_speed();
  const MotionState fastest = motion.highest_speed();
  facts.highest_speed = {fastest.speed, fastest.arc_length};
  const MotionState heaviest = motion.highest_load();
  facts.highest_load = {heaviest.normal_load, heaviest.arc_length};
  const MotionState lightest = motion.lowest_load();
  facts.lowest_load = {lightest.normal_load, lightest.arc_length};
  facts.highest_radial = highest_radial_acceleration(motion);
  return facts;
}

bool gets_onto_track(RideEnd end) {
  return end != RideEnd::flies_over_start && end != RideEnd::stands_at_start;
}

/// Which ride, and how it ended: "high friction: stalled".
std::string end_text(const std::string& place, RideEnd end) {
  return (place.empty() ? "" : place + ": ") + std::string(to_text(end));
}

}  // namespace

RideFacts facts_of(const GateRide& ride, std::string place) {
  RideFacts facts;
  facts.place = std::move(place);
  facts.end = ride.end;
  facts.ended_at = ride.ended_at;
  facts.travel_time = ride.travel_time;
  facts.exit_speed = ride.speed_at_edge;
  facts.highest_speed = {ride.highest_speed, ride.highest_speed_at};
  facts.highest_load = {ride.highest_load, ride.highest_load_at};
  facts.lowest_load = {ride.lowest_load, ride.lowest_load_at};
  facts.highest_radial = {ride.highest_radial, ride.highest_radial_at};
  return facts;
}

std::string place_of(const GateTable& table, const GateCondition& condition, const GateRide& ride) {
  return "gate " + std::to_string(ride.gate.number) +
         (table.conditions.size() > 1 ? ", " + condition.name : "");
}

std::vector<RideFacts> rides_from_start(const Track& track) {
  std::vector<RideFacts> all;
  const std::vector<LevelRide> rides = track.rides();
  for (const LevelRide& ride : rides) {
    std::string place = track.gates ? "start" : "";
    if (rides.size() > 1)
      place += (place.empty() ? "" : ", ") + std::string(to_text(ride.level)) + " friction";
    all.push_back(facts_along(*ride.motion, std::move(place)));
  }
  return all;
}

std::vector<RideFacts> all_rides(const Track& track) {
  std::vector<RideFacts> all;
  // Of equals the first is told: that from a gate.
  if (track.gates) {
    for (const auto* const conditions : {&track.gates->conditions, &track.gates->range}) {
      for (const GateCondition& condition : *conditions) {
        for (const GateRide& ride : condition.rides)
          all.push_back(facts_of(ride, place_of(*track.gates, condition, ride)));
      }
    }
  }
  for (RideFacts& ride : rides_from_start(track)) all.push_back(std::move(ride));
  return all;
}

std::string missing_arrival(const std::string& place, RideEnd end, double ended_at) {
  if (!gets_onto_track(end)) return "a feed that gets onto the track (" + end_text(place, end) + ")";
  return "rides that arrive (" + end_text(place, end) + " at " + length_text(ended_at) + ")";
}

std::string missing_arrival(const RideFacts& ride) {
  return missing_arrival(ride.place, ride.end, ride.ended_at);
}

void see_exit_speed(const RideFacts& ride, Extremes& speeds) {
  if (ride.arrived()) speeds.see({ride.exit_speed, ride.ended_at, ride.place});
  if (ride.end == RideEnd::stalled) speeds.see({0.0, ride.ended_at, end_text(ride.place, ride.end)});
}

void measure_ride(const RideFacts& ride, Measurements& measurements) {
  if (!gets_onto_track(ride.end)) {
    for (const char* const key : {"highest_speed", "highest_normal_load", "lowest_normal_load",
                                  "highest_radial_acceleration", "exit_speed", "travel_time"}) {
      measurements.lack(key, missing_arrival(ride));
    }
    return;
  }
  const auto see = [&](const char* key, const Extreme& extreme) {
    measurements.see(key, extreme.value, extreme.at, ride.place);
  };
  see("highest_speed", ride.highest_speed);
  see("highest_normal_load", ride.highest_load);
  see("lowest_normal_load", ride.lowest_load);
  see("highest_radial_acceleration", ride.highest_radial);
  Extremes exit;
  see_exit_speed(ride, exit);
  if (exit.least()) measurements.see("exit_speed", *exit.least());
  if (ride.arrived()) {
    measurements.see("travel_time", ride.travel_time, ride.ended_at, ride.place);
    return;
  }
  if (ride.end == RideEnd::stalled) {
    measurements.see("travel_time", std::numeric_limits<double>::infinity(), ride.ended_at,
                     end_text(ride.place, ride.end));
  }
  for (const char* const key : {"exit_speed", "travel_time"}) measurements.lack(key, missing_arrival(ride));
}

}  // namespace glissade::pipeline
