#include "glissade/io/file_set.hpp"

#include "glissade/io/atomic_file.hpp"
#include "glissade/io/unfinished.hpp"

#include "io/moves.hpp"
#include "io/replaceable.hpp"
#include "io/staging_folder.hpp"
#include "io/system_error.hpp"

#include <cerrno>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <sys/stat.h>

namespace glissade {

using namespace io;

namespace {

namespace fs = std::filesystem;

/// A file that is made, and where it belongs.
struct MadeFile {
  fs::path target;  // as the caller named it
  fs::path made;
  Replaceable place;
  const StagingFolder* folder;
};

}  // namespace

struct FileSet::State {
  std::map<fs::path, StagingFolder> folders;  // one a directory: files move without leaving their file system
  std::vector<MadeFile> files;

  StagingFolder& folder_beside(const fs::path& target, const fs::path& file) {
    const fs::path parent = file.parent_path().empty() ? fs::path(".") : file.parent_path();
    if (const auto known = folders.find(parent); known != folders.end()) return known->second;
    AtomicFile::remove_abandoned(parent);
    std::error_code error;
    const auto added = folders.try_emplace(parent, parent, error).first;
    if (!error) return added->second;
    folders.erase(added);
    throw system_error(target, "cannot create a file in its directory", error.value());
  }
};

FileSet::FileSet() : state_(std::make_unique<State>()) {}

FileSet::~FileSet() = default;

void FileSet::make(const fs::path& target, const std::function<void(const fs::path&)>& write) {
  Replaceable place = replaceable(target);
  StagingFolder& folder = state_->folder_beside(target, place.file);
  std::error_code error;
  const fs::path made = folder.path_for(place.file.filename(), error);
  if (error) throw system_error(target, "cannot create a file in its directory", error.value());
  named_as(made, target, [&] { write(made); });
  if (place.mode && ::chmod(made.c_str(), *place.mode) != 0)
    throw system_error(target, "cannot give it the permissions that it had", errno);
  state_->files.push_back({target, made, std::move(place), &folder});
}

void FileSet::put(const fs::path& target, std::string_view bytes) {
  make(target, [&](const fs::path& made) { write_atomically(made, bytes); });
}

void FileSet::commit() {
  const auto hold = Unfinished::hold();
  Moves moves;
  for (const MadeFile& file : state_->files) {
    named_as(file.place.file, file.target,
             [&] { moves.put(file.made, file.place.file, file.folder->attic()); });
  }
  moves.commit();
  state_->files.clear();
}

}  // namespace glissade
