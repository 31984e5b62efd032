#pragma once

#include <filesystem>
#include <optional>

#include <sys/types.h>

namespace glissade::io {

/// What a target means, and how it is replaced.
struct Replaceable {
  std::filesystem::path file;  ///< the target itself, or what its symbolic links lead to
  std::optional<mode_t> mode;  ///< permissions of the file that is there
};

/// @throws FileError if it cannot be replaced: write-protected, a directory, a device, a pipe; says why
[[nodiscard]] Replaceable replaceable(const std::filesystem::path& target);

}  // namespace glissade::io
