#include "pipeline/files/staging.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"

#include "io/moves.hpp"
#include "pipeline/files/owned_files.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <regex>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <unistd.h>

namespace glissade::pipeline {

using namespace io;

namespace {

namespace fs = std::filesystem;

FileError failure(const fs::path& path, const std::string& what, const std::error_code& reason) {
  return FileError({path.string(), what + ": " + reason.message(), "", "another directory, or free space"});
}

fs::path without_trailing_slash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

/// One build at a time changes the files of a directory: between another's list and its files those of that other would count
/// as somebody's own.
class Turn {
 public:
  explicit Turn(const fs::path& directory) {
    using namespace std::chrono_literals;
    constexpr int kMostTries =
        1000;  // budget: ten seconds; nobody waits for good for a process that is halted
    std::error_code error;
    const fs::path place = fs::canonical(directory, error);
    for (int i = 0; i < kMostTries && !error; ++i) {
      descriptor_ = locked_directory(place);
      if (descriptor_ >= 0 || errno != EWOULDBLOCK) return;
      std::this_thread::sleep_for(10ms);
    }
  }
  ~Turn() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  int descriptor_ = -1;
};

/// @return `file` with an ending that no file has
fs::path name_to_keep(const fs::path& file) {
  fs::path name = file;
  name += ".kept";
  for (int count = 2; fs::symlink_status(name).type() != fs::file_type::not_found; ++count) {
    name = file;
    name += ".kept-" + std::to_string(count);
  }
  return name;
}

}  // namespace

void require_same_design(const fs::path& target, const std::string& owner, const fs::path& design) {
  const auto other = OwnedFiles::in(target, owner).other_design(design);
  if (!other) return;
  throw FileError(
      {target.string(), "it holds files of another design of the same name, " + other->string(),
       "Files are called after their design: those of " + design.string() + " would replace them.",
       "another directory, or another name for one of the design files"});
}

namespace {

/// A file that a build of another design wrote, which is still there, and that design.
struct FileOfAnother {
  std::string name;
  fs::path design;
};

/// Of files that are in the way and not of this owner, the first that is another design's: `a` writes a.ascii.stl, and
/// so does `a.ascii`.
std::optional<FileOfAnother> file_of_another(const fs::path& target, const std::string& owner,
                                             const fs::path& design,
                                             const std::vector<std::string>& in_the_way) {
  if (in_the_way.empty() || design.empty()) return std::nullopt;
  static const std::regex kList(R"(\.([^]+)\.sha256)");
  std::error_code error;
  for (auto entry = fs::directory_iterator(target, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::smatch parts;
    const std::string list = entry->path().filename().string();
    if (!std::regex_match(list, parts, kList) || parts.str(1) == owner) continue;
    const OwnedFiles theirs = OwnedFiles::in(target, parts.str(1));
    const auto other = theirs.other_design(target / design);
    if (!other) continue;
    const auto taken = std::find_if(in_the_way.begin(), in_the_way.end(),
                                    [&](const std::string& name) { return theirs.unchanged(name); });
    if (taken != in_the_way.end()) return FileOfAnother{*taken, *other};
  }
  return std::nullopt;
}

}  // namespace

Staging::Staging(const fs::path& target, std::string owner, const fs::path& design)
    : target_(without_trailing_slash(target)), owner_(std::move(owner)) {
  require_same_design(target_, owner_, design);
  made_directories_ = make_directories(target_);
  std::error_code error;
  if (fs::exists(design, error)) design_ = fs::relative(design, target_, error);
  for (const fs::path& path : made_directories_) {
    unfinished_directories_.emplace_back(path, Unfinished::Kind::if_empty);
  }
  AtomicFile::remove_abandoned(target_);
  folder_.emplace(target_, error);
  if (error) throw failure(target_, "no file can be made in this directory", error);
}

Staging::~Staging() {
  folder_.reset();
  std::error_code ignored;
  // A directory that holds something by now does not go.
  std::for_each(made_directories_.rbegin(), made_directories_.rend(),
                [&](const fs::path& path) { fs::remove(path, ignored); });
}

fs::path Staging::path_for(const std::string& name) {
  names_.push_back(name);
  std::error_code error;
  fs::path path = folder_->path_for(name, error);
  if (error) throw failure(path.parent_path(), "this directory cannot be made", error);
  return path;
}

void Staging::require_of_no_other(const std::vector<std::string>& in_the_way) const {
  const auto theirs = file_of_another(target_, owner_, design_, in_the_way);
  if (!theirs) return;
  throw FileError({(target_ / theirs->name).string(),
                   "a build of another design, " + theirs->design.string() + ", wrote this file",
                   "Files are called after their design: " + owner_ + " has one of the same name.",
                   "another directory, or another name for one of the design files"});
}

Published Staging::publish() {
  const Turn turn(target_);
  const auto hold = Unfinished::hold();
  const fs::path made = folder_->path() / "new";
  const fs::path attic = folder_->attic();
  const std::string list = OwnedFiles::list_name(owner_);
  named_as(made / list, target_ / list,
           [&] { write_atomically(made / list, OwnedFiles::list_of(made, names_, design_)); });

  const OwnedFiles owned = OwnedFiles::in(target_, owner_);
  const std::set<std::string> wanted(names_.begin(), names_.end());
  std::set<std::string> in_the_way;
  for (const std::string& name : names_) {
    if (fs::exists(fs::symlink_status(target_ / name)) && !owned.unchanged(name)) in_the_way.insert(name);
  }
  require_of_no_other({in_the_way.begin(), in_the_way.end()});
  Published published;
  Moves moves;
  for (const std::string& name : names_) {
    const fs::path place = target_ / name;
    if (fs::is_directory(place)) {
      throw FileError(
          {place.string(), "a directory has the name of a file to be written", "", "another directory"});
    }
    if (in_the_way.contains(name)) {
      published.set_aside.push_back(name_to_keep(place));
      moves.move(place, published.set_aside.back());
    }
    moves.put(made / name, place, attic);
    published.files.push_back(place);
  }
  for (const std::string& name : owned.names()) {
    if (wanted.contains(name) || !owned.unchanged(name)) continue;
    if (stays_ && stays_(target_ / name)) continue;
    moves.remove(target_ / name, attic);
    published.removed.push_back(target_ / name);
  }
  // Last: where a process is killed on the way, files that the old list does not know count as somebody's own.
  moves.put(made / list, target_ / list, attic);
  moves.commit();
  return published;
}

}  // namespace glissade::pipeline
