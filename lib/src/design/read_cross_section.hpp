#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

#include <optional>

namespace glissade::design_file {

/// The group `cross_section` of a design; none if it has none, or no kind.
[[nodiscard]] std::optional<CrossSectionDesign> read_cross_section(MapReader& top, Findings& findings);

}  // namespace glissade::design_file
