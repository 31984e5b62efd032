#include "app/file_watch.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>

#include <sys/stat.h>

namespace glissade::app {
namespace {

/// Between two looks: what follows a save at once, and long enough for one to be over.
constexpr std::chrono::milliseconds kPause{200};

/// @return false if `stop` cut it short
bool pause(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any woken;
  std::unique_lock lock(mutex);
  woken.wait_for(lock, stop, kPause, [] { return false; });
  return !stop.stop_requested();
}

}  // namespace

std::optional<FileStamp> stamp_of(const std::filesystem::path& file) {
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0) return {};
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  return FileStamp{status.st_dev, status.st_ino, status.st_size,
                   status.st_mtim.tv_sec * kNanoseconds + status.st_mtim.tv_nsec};
}

void FileWatch::add(const std::filesystem::path& file) {
  if (std::find(files_.begin(), files_.end(), file) != files_.end()) return;
  files_.push_back(file);
  stamps_.push_back(stamp_of(file));
}

FileWatch::Stamps FileWatch::look() const {
  Stamps stamps;
  for (const std::filesystem::path& file : files_) stamps.push_back(stamp_of(file));
  return stamps;
}

bool FileWatch::wait(const std::stop_token& stop) const {
  Stamps last = look();
  while (pause(stop)) {
    Stamps now = look();
    if (now != stamps_ && now == last) return true;
    last = std::move(now);
  }
  return false;
}

}  // namespace glissade::app
