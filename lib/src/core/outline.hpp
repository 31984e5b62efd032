#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/vec.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade::core {

/// @return why the corners are no simple polygon of sensible size, none if they are one
[[nodiscard]] std::optional<Issue> outline_fault(const std::vector<Vec2>& outline, const std::string& name);

/// @return true if the point lies on an edge
[[nodiscard]] bool touches_outline(const std::vector<Vec2>& outline, Vec2 point);
/// @return true if the point lies inside or on an edge
[[nodiscard]] bool inside_outline(const std::vector<Vec2>& outline, Vec2 point);

}  // namespace glissade::core
