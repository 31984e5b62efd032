#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

#include <optional>

namespace glissade::design_file {

/// Reads the group `gates`, if there is one.
[[nodiscard]] std::optional<GatesDesign> read_gates(MapReader& top, Findings& findings);

}  // namespace glissade::design_file
