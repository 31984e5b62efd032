#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

#include <optional>

namespace glissade::design_file {

/// Reads the `limits:` section, if there is one, and the objective in it.
void read_limits(MapReader& top, Design& design, Findings& findings);

/// Reads a map of `lowest` and `highest`.
[[nodiscard]] Range read_range(const Value& value, Dimension dimension, Findings& findings);

}  // namespace glissade::design_file
