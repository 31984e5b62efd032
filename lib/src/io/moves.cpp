#include "io/moves.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <string>
#include <system_error>

namespace glissade::io {
namespace {

namespace fs = std::filesystem;

FileError not_placed(const fs::path& path, const std::string& what, const std::error_code& reason) {
  return FileError({path.string(), what + ": " + reason.message(), "", "another directory, or free space"});
}

}  // namespace

std::vector<fs::path> make_directories(const fs::path& target) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path path = target; !path.empty() && !fs::exists(path, error); path = path.parent_path()) {
    if (error) break;
    missing.push_back(path);
  }
  std::reverse(missing.begin(), missing.end());
  fs::create_directories(target, error);
  if (error) throw not_placed(target, "this directory cannot be made", error);
  return missing;
}

Moves::~Moves() {
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

void Moves::commit() {
  done_.clear();
  made_.clear();
}

fs::path Moves::next_in(const fs::path& attic) const {
  return attic / std::to_string(done_.size());
}

void Moves::remove(const fs::path& file, const fs::path& attic) {
  move(file, next_in(attic));
}

void Moves::move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw not_placed(from, "this file cannot be moved", error);
  done_.push_back({from, to, false});
}

void Moves::put(const fs::path& from, const fs::path& place, const fs::path& attic) {
  std::error_code error;
  const bool replaces = fs::exists(fs::symlink_status(place));
  const fs::path old = next_in(attic);
  if (replaces) {
    fs::create_hard_link(place, old, error);
    if (error) fs::copy_file(place, old, error);
  } else if (place.has_parent_path()) {
    const std::vector<fs::path> made = make_directories(place.parent_path());
    made_.insert(made_.end(), made.begin(), made.end());
  }
  if (!error) fs::rename(from, place, error);
  if (error) throw not_placed(place, "this file cannot be put in its place", error);
  done_.push_back(replaces ? Move{place, old, false} : Move{place, {}, true});
}

}  // namespace glissade::io
