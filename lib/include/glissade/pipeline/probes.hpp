#pragma once

#include "glissade/motion/probe.hpp"
#include "glissade/pipeline/solve.hpp"

#include <vector>

namespace glissade {

/// Every probe of a design read on its track; one that lies beside the track is left out, and warnings() tells
/// of it.
[[nodiscard]] std::vector<ProbeReading> probe_readings(const Design& design, const Track& track);

}  // namespace glissade
