#include "pipeline/staging.hpp"

#include "glissade/core/error.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <string>
#include <system_error>
#include <utility>

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

/// A file on its way to its place, with what is needed to take it back.
struct Move {
  fs::path from;
  fs::path to;
  fs::path kept;  // the file that was at `to`; empty if none
};

void undo(const std::vector<Move>& moves) {
  std::error_code ignored;
  for (const Move& move : moves) {
    if (move.kept.empty()) {
      fs::remove(move.to, ignored);
    } else {
      fs::rename(move.kept, move.to, ignored);
    }
  }
}

}  // namespace

Staging::Staging(const fs::path& target)
    : target_(without_trailing_slash(target)), made_directories_(make_directories(target_)) {
  static std::atomic<unsigned> counter{0};
  directory_ = target_ / (".glissade-" + std::to_string(::getpid()) + "-" + std::to_string(++counter));
  std::error_code error;
  fs::create_directory(directory_, error);
  if (error) throw failure(target_, "no file can be made in this directory", error);
}

Staging::~Staging() {
  std::error_code ignored;
  fs::remove_all(directory_, ignored);
  // A directory that holds something by now does not go.
  std::for_each(made_directories_.rbegin(), made_directories_.rend(),
                [&](const fs::path& path) { fs::remove(path, ignored); });
}

fs::path Staging::path_for(const std::string& name) {
  names_.push_back(name);
  return directory_ / name;
}

std::vector<fs::path> Staging::publish() {
  std::vector<Move> done;
  std::vector<fs::path> places;
  std::error_code error;
  for (const std::string& name : names_) {
    Move move{directory_ / name, target_ / name, {}};
    if (fs::is_directory(move.to)) {
      undo(done);
      throw FileError({move.to.string(), "a directory has the name of a file to be written", "",
                       "another directory with -o"});
    }
    if (fs::exists(move.to)) {
      // A second name for the old file, so that there is no moment without one.
      move.kept = directory_ / (name + ".old");
      fs::create_hard_link(move.to, move.kept, error);
      if (error) fs::copy_file(move.to, move.kept, error);
    }
    if (!error) fs::rename(move.from, move.to, error);
    if (error) {
      undo(done);
      throw failure(move.to, "this file cannot be put in its place", error);
    }
    places.push_back(move.to);
    done.push_back(std::move(move));
  }
  return places;
}

}  // namespace glissade::pipeline
