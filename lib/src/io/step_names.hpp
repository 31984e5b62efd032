#pragma once

#include "glissade/parts/shop_part.hpp"

#include <string>

namespace glissade::io {

/// @return what a part is called in an assembly: "03 left_wall"
[[nodiscard]] std::string step_name(const ShopPart& part);

/// @return a text as STEP writes it, in quotes: quotes and backslashes doubled, other than ASCII as \X2\....\X0\,
///         control characters as spaces
[[nodiscard]] std::string step_string(const std::string& text);

/// @return the text that a quoted string holds
[[nodiscard]] std::string step_string_value(const std::string& quoted);

}  // namespace glissade::io
