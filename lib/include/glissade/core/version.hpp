#pragma once

#include <string_view>

namespace glissade {

/// @return the version of the library, "major.minor.patch"
[[nodiscard]] std::string_view version();

}  // namespace glissade
