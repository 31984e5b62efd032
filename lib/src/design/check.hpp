#pragma once

#include "glissade/design/design.hpp"

#include "design/findings.hpp"

#include <optional>
#include <vector>

namespace glissade::design_file {

/// Every problem of a design's values except that of reach.
[[nodiscard]] std::vector<Finding> check_values(const Design& design);
[[nodiscard]] std::optional<Finding> find_unreachable(const Design& design);

/// Where `segments` lead: run towards the finish, and height (negative below the start) [m].
[[nodiscard]] Vec2 end_of_segments(const CenterlineDesign& centerline);

}  // namespace glissade::design_file
