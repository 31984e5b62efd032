#pragma once

#include "glissade/study/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace glissade::study {

/// @return what is studied as the text of manifest.json: the same bytes for the same study, wherever it runs
/// @throws FileError if a profile that the design names cannot be read
[[nodiscard]] std::string manifest_text(const Study& study, const std::vector<std::string>& columns);

/// Puts the manifest into the directory, or holds it against the one that is there.
/// @throws InputError if another study's is there, with what differs; FileError
void place_manifest(const std::filesystem::path& directory, const std::string& text);

[[nodiscard]] std::filesystem::path chunk_path(const std::filesystem::path& directory, std::uint64_t chunk);

}  // namespace glissade::study
