#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

namespace glissade::design_file {

/// Reads the `fabrication:` section; none where there is none.
[[nodiscard]] std::optional<FabricationDesign> read_fabrication(MapReader& top, Findings& findings);

}  // namespace glissade::design_file
