#pragma once

#include "glissade/design/probe_design.hpp"

#include "design/map_reader.hpp"

#include <vector>

namespace glissade::design_file {

/// The list `probes` of a design; empty if it has none.
[[nodiscard]] std::vector<ProbeDesign> read_probes(MapReader& top, Findings& findings);

}  // namespace glissade::design_file
