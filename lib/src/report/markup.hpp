#pragma once

#include <string>
#include <string_view>

namespace glissade::report {

/// @return text as it stands between tags or in a quoted attribute of HTML and SVG; control characters, which
///         XML forbids, become spaces
[[nodiscard]] std::string escaped_markup(std::string_view text);

}  // namespace glissade::report
