#pragma once

#include "glissade/core/error.hpp"

#include <filesystem>

namespace glissade::study {

/// What is told where a sweep, or a look through its rows, was asked to end.
/// @param directory  of the sweep
inline Issue interrupted_sweep(const std::filesystem::path& directory) {
  return {directory.string(), "interrupted; the rows that are written stay",
          "The same command goes on where this one ended.", ""};
}

}  // namespace glissade::study
