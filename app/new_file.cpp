#include "app/new_file.hpp"

#include "glissade/core/error.hpp"

namespace glissade::app {

void require_new(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return;
  throw FileError({path.string(), "the file exists already", "It may hold work of yours.",
                   "another name, or --force to replace it"});
}

}  // namespace glissade::app
