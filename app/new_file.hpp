#pragma once

#include <filesystem>

namespace glissade::app {

/// @throws FileError if there is something of that name already, with the way to replace it
void require_new(const std::filesystem::path& path);

}  // namespace glissade::app
