#include "io/staging_folder.hpp"

#include <atomic>
#include <cerrno>
#include <regex>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace glissade::io {

namespace fs = std::filesystem;

int locked_directory(const fs::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    return -1;
  }
  return descriptor;
}

StagingFolder::StagingFolder(const fs::path& target, std::error_code& error) {
  static std::atomic<unsigned> counter{0};
  constexpr int kMostTries =
      100;  // budget: one is lost where another process takes the new directory for abandoned
  for (int i = 0; i < kMostTries; ++i) {
    // A program that ends meanwhile knows of the directory, or waits with it for good.
    const auto hold = Unfinished::hold();
    path_ = target / (".glissade-" + std::to_string(::getpid()) + "-" + std::to_string(++counter));
    const bool made = fs::create_directory(path_, error);
    if (error) return;
    if (!made) continue;
    lock_ = locked_directory(path_);
    // Without locks on this file system nobody takes it for abandoned either.
    if (fs::exists(path_, error)) {
      unfinished_.emplace(path_);
      fs::create_directory(attic(), error);
      return;
    }
    if (lock_ >= 0) ::close(std::exchange(lock_, -1));
  }
  error = std::make_error_code(std::errc::file_exists);
}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  if (unfinished_) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

fs::path StagingFolder::path_for(const fs::path& name, std::error_code& error) {
  fs::path path = path_ / "new" / name;
  // Of a program that ends nothing is made again that has been taken away.
  const auto hold = Unfinished::hold();
  fs::create_directories(path.parent_path(), error);
  return path;
}

void remove_abandoned_folders(const fs::path& target) {
  static const std::regex kName(R"(\.glissade-[0-9]+-[0-9]+)");
  std::error_code error;
  std::vector<fs::path> candidates;
  for (auto entry = fs::directory_iterator(target, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (std::regex_match(entry->path().filename().string(), kName)) candidates.push_back(entry->path());
  }
  for (const fs::path& path : candidates) {
    if (fs::symlink_status(path, error).type() != fs::file_type::directory) continue;
    const int lock = locked_directory(path);
    if (lock < 0) continue;
    fs::remove_all(path, error);
    ::close(lock);
  }
}

}  // namespace glissade::io
