#pragma once

#include "glissade/trades/chute/materials.hpp"

#include <filesystem>
#include <string_view>

namespace glissade {

/// @return the materials and liners of lib/data/materials, which the program carries
[[nodiscard]] const MaterialLibrary& shipped_materials();

/// Reads text in the form of the files of lib/data/materials; docs/materials.md describes its keys.
/// @param file  names it in messages
/// @throws InputError with every problem at once: unknown or missing keys, sources, units, bounds
[[nodiscard]] MaterialLibrary parse_materials(std::string_view text, const std::filesystem::path& file);

}  // namespace glissade
