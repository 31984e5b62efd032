#pragma once

#include "glissade/pipeline/solve.hpp"

#include <string>

namespace glissade::app {

/// @return labelled lines of how a stream fills its channel; a table over the friction range where there is one
[[nodiscard]] std::string stream_lines(const Design& design, const Track& track);

}  // namespace glissade::app
