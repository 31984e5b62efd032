#pragma once

#include "glissade/design/design.hpp"

#include "design/findings.hpp"

#include <optional>
#include <vector>

namespace glissade::design_file {

/// Every problem of a design's values except that of reach.
[[nodiscard]] std::vector<Finding> check_values(const Design& design);
[[nodiscard]] std::optional<Finding> find_unreachable(const Design& design);

/// Where `segments`, which can be drawn, lead.
[[nodiscard]] Endpoints end_of_segments(const Design& design);

}  // namespace glissade::design_file
