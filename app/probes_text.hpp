#pragma once

#include "glissade/pipeline.hpp"

#include <string>

namespace glissade::app {

/// @return the probes of a design as a table, one row a probe and friction; empty without probes
[[nodiscard]] std::string probes_lines(const Design& design, const Track& track);

}  // namespace glissade::app
