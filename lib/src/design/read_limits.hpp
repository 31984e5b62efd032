#pragma once

#include "glissade/design/limits_design.hpp"

#include "design/map_reader.hpp"

#include <optional>

namespace glissade::design_file {

/// Reads the `limits:` section, if there is one.
[[nodiscard]] std::optional<LimitsDesign> read_limits(MapReader& top, Findings& findings);

/// Reads a map of `lowest` and `highest`.
[[nodiscard]] LimitRange read_range(const Value& value, Dimension dimension, Findings& findings);

}  // namespace glissade::design_file
