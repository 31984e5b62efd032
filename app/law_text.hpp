#pragma once

#include "glissade/pipeline.hpp"

#include <string>
#include <string_view>

namespace glissade::app {

/// @return what resists the body, for the task line: ", friction angle 17 deg (coefficient 0.3057)"
[[nodiscard]] std::string resistance_text(const Design& design);

/// @return how the ride of a body that is not a sliding point ended, "arrived", "stalled", ...
[[nodiscard]] std::string_view ride_status(const Motion& motion);

/// @return the line of a ride that the body's law ended
[[nodiscard]] std::string law_end_text(const Motion& motion);

/// @return labelled lines of what the body's law adds to the ride; empty for a sliding point
[[nodiscard]] std::string law_lines(const Design& design, const Track& track);

}  // namespace glissade::app
