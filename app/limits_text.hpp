#pragma once

#include "glissade/pipeline.hpp"

#include <string>

namespace glissade::app {

/// Lines of a summary: how the search within the limits ended, then every limit with its bound, what the
/// track makes of it and what it costs; empty for a design without limits.
[[nodiscard]] std::string limits_lines(const Design& design, const Track& track);

/// @return "kept", "2 broken", or "-" for a design without limits
[[nodiscard]] std::string limits_verdict(const Track& track);

}  // namespace glissade::app
