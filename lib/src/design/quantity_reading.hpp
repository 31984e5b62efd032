#pragma once

#include "glissade/core/error.hpp"
#include "glissade/design/quantity.hpp"

#include <string_view>
#include <variant>

namespace glissade::design_file {

/// @return the value in SI units and radians, or what is wrong with the text (its `where` left empty)
[[nodiscard]] std::variant<double, Issue> read_quantity(std::string_view text, Dimension dimension,
                                                        std::string_view name);

}  // namespace glissade::design_file
