#include "glissade/io/unfinished.hpp"

#include <map>
#include <system_error>
#include <utility>

namespace glissade {
namespace {

// Never destroyed: threads may still write while the program ends.
std::recursive_mutex& mutex() {
  static auto* const kMutex = new std::recursive_mutex;
  return *kMutex;
}

std::multimap<std::filesystem::path, Unfinished::Kind>& paths() {
  static auto* const kPaths = new std::multimap<std::filesystem::path, Unfinished::Kind>;
  return *kPaths;
}

void take_away(const std::filesystem::path& path) {
  // Another thread may be adding to a directory.
  constexpr int kMostTries = 5;
  std::error_code ignored;
  for (int i = 0; i < kMostTries; ++i) {
    if (std::filesystem::symlink_status(path, ignored).type() == std::filesystem::file_type::not_found)
      return;
    std::filesystem::remove_all(path, ignored);
  }
}

}  // namespace

Unfinished::Unfinished(std::filesystem::path path, Kind kind) : path_(std::move(path)) {
  const std::scoped_lock lock(mutex());
  paths().emplace(path_, kind);
}

Unfinished::~Unfinished() {
  const std::scoped_lock lock(mutex());
  if (const auto found = paths().find(path_); found != paths().end()) paths().erase(found);
}

std::unique_lock<std::recursive_mutex> Unfinished::hold() {
  return std::unique_lock(mutex());
}

void discard_unfinished() {
  mutex().lock();  // for good
  std::error_code ignored;
  // What lies in a directory comes after it.
  for (auto entry = paths().rbegin(); entry != paths().rend(); ++entry) {
    if (entry->second == Unfinished::Kind::whole) {
      take_away(entry->first);
    } else {
      std::filesystem::remove(entry->first, ignored);
    }
  }
}

}  // namespace glissade
