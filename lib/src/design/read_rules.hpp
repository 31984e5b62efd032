#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

namespace glissade::design_file {

/// Reads the group `rules` of a design, and with it what it names; the design's centerline is known by then.
void read_rules(MapReader& top, Design& design, Findings& findings);

}  // namespace glissade::design_file
