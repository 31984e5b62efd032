#pragma once

#include "glissade/pipeline.hpp"

#include "app/table.hpp"

#include <string>

namespace glissade::app {

/// @return a table of rides: time, speeds, loads, how far each is from a stall; ready for rows of add_ride()
[[nodiscard]] Table rides_table(const std::string& heading);

/// Adds a ride as a row.
/// @param name         of the row: "low, 14 deg"
/// @param stall_angle  of the track, as stall_angle_of() gives it
/// @param limits       what became of the limits; empty: no such column
void add_ride(Table& table, const std::string& name, const Motion& motion,
              const std::optional<Angle>& stall_angle, const std::string& limits = {});

/// @return how far a track's body is from a stall, and where the design has a friction range its rides as a
///         table
[[nodiscard]] std::string friction_lines(const Track& track);

}  // namespace glissade::app
