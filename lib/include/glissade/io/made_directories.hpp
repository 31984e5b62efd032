#pragma once

#include "glissade/io/unfinished.hpp"

#include <filesystem>
#include <list>
#include <vector>

namespace glissade {

/// The directories that a command makes for its files: those that stay empty go with this, those that were there stay.
class MadeDirectories {
 public:
  MadeDirectories() = default;
  ~MadeDirectories();
  MadeDirectories(const MadeDirectories&) = delete;
  MadeDirectories& operator=(const MadeDirectories&) = delete;

  /// Makes a directory and those that it lies in, where they are missing.
  /// @throws FileError if it cannot be made, or a file has its name
  void make(const std::filesystem::path& directory);

  /// They stay from here on, empty or not: others may count on them.
  void keep();

 private:
  std::vector<std::filesystem::path> made_;  // outer ones before those in them
  std::list<Unfinished> unfinished_;
};

}  // namespace glissade
