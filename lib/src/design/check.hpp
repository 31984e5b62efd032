#pragma once

#include "glissade/design/design.hpp"

#include "design/findings.hpp"

#include <optional>
#include <vector>

namespace glissade::design_file {

/// Every problem of a design's values except that of reach.
[[nodiscard]] std::vector<Finding> check_values(const Design& design);

/// @param reading  what is wrong with single values
/// @return what check_values() finds whatever stands in the groups that could not be read: such a group is not missing,
///         and what it would say is not known
[[nodiscard]] std::vector<Finding> sure_findings(const Design& design, const Findings& reading);
[[nodiscard]] std::optional<Finding> find_unreachable(const Design& design);

/// Where `segments`, which can be drawn, lead.
[[nodiscard]] Endpoints end_of_segments(const Design& design);

}  // namespace glissade::design_file
