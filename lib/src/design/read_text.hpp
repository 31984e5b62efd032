#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace glissade::design_file {

/// Reads a whole text file of at most 4 MiB.
/// @param what   for messages: "the design file"
/// @param maker  the command that makes or lists such files, for the hint where there is none
/// @throws FileError if it cannot be read or is larger
[[nodiscard]] std::string read_text(const std::filesystem::path& file, std::string_view what,
                                    std::string_view maker);

}  // namespace glissade::design_file
