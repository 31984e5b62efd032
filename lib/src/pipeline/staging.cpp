#include "pipeline/staging.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"

#include "pipeline/owned_files.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <regex>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace glissade::pipeline {
namespace {

namespace fs = std::filesystem;

FileError failure(const fs::path& path, const std::string& what, const std::error_code& reason) {
  return FileError(
      {path.string(), what + ": " + reason.message(), "", "another directory with -o, or free space"});
}

/// @return the directories that had to be made, outermost first
std::vector<fs::path> make_directories(const fs::path& target) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path path = target; !path.empty() && !fs::exists(path, error); path = path.parent_path()) {
    if (error) break;
    missing.push_back(path);
  }
  std::reverse(missing.begin(), missing.end());
  fs::create_directories(target, error);
  if (error) throw failure(target, "this directory cannot be made", error);
  return missing;
}

fs::path without_trailing_slash(const fs::path& path) {
  return path.has_filename() ? path : path.parent_path();
}

/// @return a descriptor that holds the lock on a directory until it is closed; -1 if another holds it, or the
///         file system has no locks
int locked(const fs::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    return -1;
  }
  return descriptor;
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
      descriptor_ = locked(place);
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

/// Removes what killed processes left: directories of the name that Staging gives, and of no other, that nobody
/// has locked.
void remove_abandoned(const fs::path& target) {
  static const std::regex kName(R"(\.glissade-[0-9]+-[0-9]+)");
  std::error_code error;
  std::vector<fs::path> candidates;
  for (auto entry = fs::directory_iterator(target, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (std::regex_match(entry->path().filename().string(), kName)) candidates.push_back(entry->path());
  }
  for (const fs::path& path : candidates) {
    if (fs::symlink_status(path, error).type() != fs::file_type::directory) continue;
    const int lock = locked(path);
    if (lock < 0) continue;
    fs::remove_all(path, error);
    ::close(lock);
  }
}

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

/// Moves that can be taken back.
class Moves {
 public:
  explicit Moves(fs::path attic) : attic_(std::move(attic)) {}
  Moves(const Moves&) = delete;
  Moves& operator=(const Moves&) = delete;
  ~Moves() {
    std::error_code ignored;
    std::for_each(done_.rbegin(), done_.rend(), [&](const Move& move) {
      if (move.is_new) {
        fs::remove(move.from, ignored);
      } else {
        fs::rename(move.to, move.from, ignored);
      }
    });
    std::for_each(made_.rbegin(), made_.rend(), [&](const fs::path& path) { fs::remove(path, ignored); });
  }

  void commit() {
    done_.clear();
    made_.clear();
  }

  /// Takes a file out of the way, to be gone with the attic.
  void remove(const fs::path& file) { move(file, attic_ / std::to_string(done_.size())); }

  void move(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) throw failure(from, "this file cannot be moved", error);
    done_.push_back({from, to, false});
  }

  /// Puts a new file in its place; an old one is replaced without a moment in which there is none.
  void put(const fs::path& from, const fs::path& place) {
    std::error_code error;
    const bool replaces = fs::exists(fs::symlink_status(place));
    const fs::path old = attic_ / std::to_string(done_.size());
    if (replaces) {
      fs::create_hard_link(place, old, error);
      if (error) fs::copy_file(place, old, error);
    } else {
      const std::vector<fs::path> made = make_directories(place.parent_path());
      made_.insert(made_.end(), made.begin(), made.end());
    }
    if (!error) fs::rename(from, place, error);
    if (error) throw failure(place, "this file cannot be put in its place", error);
    done_.push_back(replaces ? Move{place, old, false} : Move{place, {}, true});
  }

 private:
  struct Move {
    fs::path from;
    fs::path to;
    bool is_new;  // there was nothing at `from`
  };
  fs::path attic_;
  std::vector<Move> done_;
  std::vector<fs::path> made_;  // directories, outermost first
};

}  // namespace

void require_same_design(const fs::path& target, const std::string& owner, const fs::path& design) {
  const auto other = OwnedFiles::in(target, owner).other_design(design);
  if (!other) return;
  throw FileError(
      {target.string(), "it holds files of another design of the same name, " + other->string(),
       "Files are called after their design: those of " + design.string() + " would replace them.",
       "another directory with -o, or another name for one of the design files"});
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
  remove_abandoned(target_);
  AtomicFile::remove_abandoned(target_);
  lock_new_directory();
}

void Staging::lock_new_directory() {
  static std::atomic<unsigned> counter{0};
  constexpr int kMostTries = 100;  // one is lost where another build takes the new directory for abandoned
  std::error_code error;
  for (int i = 0; i < kMostTries; ++i) {
    // A program that ends meanwhile knows of the directory, or waits with it for good.
    const auto hold = Unfinished::hold();
    directory_ = target_ / (".glissade-" + std::to_string(::getpid()) + "-" + std::to_string(++counter));
    const bool made = fs::create_directory(directory_, error);
    if (error) break;
    if (!made) continue;
    lock_ = locked(directory_);
    // Without locks on this file system nobody takes it for abandoned either.
    if (fs::exists(directory_, error)) {
      unfinished_.emplace(directory_);
      return;
    }
    if (lock_ >= 0) ::close(std::exchange(lock_, -1));
  }
  if (!error) error = std::make_error_code(std::errc::file_exists);
  throw failure(target_, "no file can be made in this directory", error);
}

Staging::~Staging() {
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
  if (lock_ >= 0) ::close(lock_);
  // A directory that holds something by now does not go.
  std::for_each(made_directories_.rbegin(), made_directories_.rend(),
                [&](const fs::path& path) { fs::remove(path, ignored); });
}

fs::path Staging::path_for(const std::string& name) {
  names_.push_back(name);
  const fs::path path = directory_ / "new" / name;
  // Of a program that ends nothing is made again that has been taken away.
  const auto hold = Unfinished::hold();
  (void)make_directories(path.parent_path());
  return path;
}

void Staging::require_of_no_other(const std::vector<std::string>& in_the_way) const {
  const auto theirs = file_of_another(target_, owner_, design_, in_the_way);
  if (!theirs) return;
  throw FileError({(target_ / theirs->name).string(),
                   "a build of another design, " + theirs->design.string() + ", wrote this file",
                   "Files are called after their design: " + owner_ + " has one of the same name.",
                   "another directory with -o, or another name for one of the design files"});
}

Published Staging::publish() {
  const Turn turn(target_);
  const auto hold = Unfinished::hold();
  const fs::path made = directory_ / "new";
  const fs::path attic = directory_ / "old";
  (void)make_directories(attic);
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
  Moves moves(attic);
  for (const std::string& name : names_) {
    const fs::path place = target_ / name;
    if (fs::is_directory(place)) {
      throw FileError({place.string(), "a directory has the name of a file to be written", "",
                       "another directory with -o"});
    }
    if (in_the_way.contains(name)) {
      published.set_aside.push_back(name_to_keep(place));
      moves.move(place, published.set_aside.back());
    }
    moves.put(made / name, place);
    published.files.push_back(place);
  }
  for (const std::string& name : owned.names()) {
    if (wanted.contains(name) || !owned.unchanged(name)) continue;
    if (stays_ && stays_(target_ / name)) continue;
    moves.remove(target_ / name);
    published.removed.push_back(target_ / name);
  }
  // Last: where a process is killed on the way, files that the old list does not know count as somebody's own.
  moves.put(made / list, target_ / list);
  moves.commit();
  return published;
}

}  // namespace glissade::pipeline
