#pragma once

#include "glissade/design/body_design.hpp"

#include "design/map_reader.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace glissade::design_file {

/// @return every key that a body may have
[[nodiscard]] const std::vector<std::string_view>& body_keys();

/// @return the friction that a friction angle of a design means [rad]; none if it is out of range
[[nodiscard]] std::optional<Friction> friction_of_angle(double angle);

/// Reads the value of a friction key: an angle or a number. One that belongs under the key of the other is told so.
[[nodiscard]] std::optional<double> as_friction(const Value& value, Dimension dimension, Findings& findings);

/// Reads the group `body` of a design.
/// @param friction_may_follow  from the material of a stream: then it need not be told
[[nodiscard]] BodyDesign read_body(MapReader& top, bool friction_may_follow, Findings& findings);

}  // namespace glissade::design_file
