#pragma once

#include "glissade/design/design.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace glissade::pipeline {

/// Looks that no file is put in the place of one that a design reads, or of the design itself, by whatever path.
/// @param names  of the files that are to be written, relative to `directory`
/// @throws InputError with the key that names the file
void require_none_read(const Design& design, const std::filesystem::path& directory,
                       const std::vector<std::string>& names);

/// @return whether a file is one that a design reads, or the design itself, by whatever path
[[nodiscard]] bool is_read_by(const Design& design, const std::filesystem::path& file);

}  // namespace glissade::pipeline
