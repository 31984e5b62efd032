#include "glissade/io/made_directories.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <system_error>

namespace glissade {

namespace fs = std::filesystem;

MadeDirectories::~MadeDirectories() {
  std::error_code ignored;
  // A directory that holds something by now does not go.
  std::for_each(made_.rbegin(), made_.rend(), [&](const fs::path& path) { fs::remove(path, ignored); });
}

void MadeDirectories::keep() {
  made_.clear();
  unfinished_.clear();
}

void MadeDirectories::make(const fs::path& directory) {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path path = directory; !path.empty() && !fs::exists(path, error); path = path.parent_path()) {
    if (error) break;
    missing.push_back(path);
  }
  fs::create_directories(directory, error);
  for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
    made_.push_back(*path);
    unfinished_.emplace_back(*path, Unfinished::Kind::if_empty);
  }
  if (!error && fs::is_directory(directory)) return;
  throw FileError({directory.string(),
                   "cannot be made: " + (error ? error.message() : "there is a file of this name"), "",
                   "another directory"});
}

}  // namespace glissade
