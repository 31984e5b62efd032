#pragma once

#include "glissade/design/body_design.hpp"

#include "design/map_reader.hpp"

#include <string_view>
#include <vector>

namespace glissade::design_file {

/// @return every key that a body may have
[[nodiscard]] const std::vector<std::string_view>& body_keys();

/// Reads the group `body` of a design.
/// @param friction_may_follow  from the material of a stream: then it need not be told
[[nodiscard]] BodyDesign read_body(MapReader& top, bool friction_may_follow, Findings& findings);

}  // namespace glissade::design_file
