#pragma once

#include "glissade/design/design.hpp"

#include "design/findings.hpp"
#include "design/map_reader.hpp"

namespace glissade::design_file {

/// Reads `entry_slope_angle` and `segments` of a centerline of that kind.
void read_segments(MapReader& map, CenterlineDesign& centerline, Findings& findings);

}  // namespace glissade::design_file
