#pragma once

#include "glissade/pipeline/solve.hpp"

#include <vector>

namespace glissade::pipeline {

/// @return a problem for each probe that the track does not pass
[[nodiscard]] std::vector<Issue> probes_beside_track(const Design& design, const Track& track);

}  // namespace glissade::pipeline
