#pragma once

#include "glissade/pipeline/solve.hpp"

#include <string>
#include <vector>

namespace glissade::pipeline {

/// The design's body down a track at the ends of its friction range.
[[nodiscard]] std::vector<RangeRide> rides_of_range(const Design& design, const CenterlinePtr& centerline);

/// @return "at high friction, 20 deg"
[[nodiscard]] std::string at_friction_text(const LevelRide& ride);

}  // namespace glissade::pipeline
