#pragma once

#include "glissade/io/stations_csv.hpp"
#include "glissade/pipeline.hpp"

#include <vector>

namespace glissade::pipeline {

/// A track and the body on it at each of the stations, at every friction of the design.
/// @param arc_lengths  ascending [m]
[[nodiscard]] StationTable stations_of(const Track& track, const std::vector<double>& arc_lengths);

}  // namespace glissade::pipeline
