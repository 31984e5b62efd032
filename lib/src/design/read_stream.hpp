#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

#include <optional>

namespace glissade::design_file {

/// Reads the group `stream`, if the file has it.
[[nodiscard]] std::optional<StreamDesign> read_stream(MapReader& top, Findings& findings);

/// Fills in what follows from the stream's material where the file says nothing else.
void follow_material(Design& design, Findings& findings);

}  // namespace glissade::design_file
