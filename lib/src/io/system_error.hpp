#pragma once

#include "glissade/core/error.hpp"

#include <filesystem>
#include <string>

namespace glissade::io {

/// @param what  what could not be done: "cannot write"
/// @param code  errno of the call that failed
/// @return an error that says what the system said and what to try
[[nodiscard]] FileError system_error(const std::filesystem::path& file, const std::string& what, int code);

}  // namespace glissade::io
