#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace glissade::pipeline {

/// A directory inside the target directory in which files are made and checked before all of them move to
/// their places together. What has not been published is gone when this is destroyed, the target directory
/// too where it was made for this and stayed empty.
class Staging {
 public:
  /// @throws FileError if `target` cannot be made or written to
  explicit Staging(const std::filesystem::path& target);
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// @return where to make the file that will be called `name`
  [[nodiscard]] std::filesystem::path path_for(const std::string& name);

  /// Moves every file to its place; a file that was there is replaced. Should one move fail, those before it
  /// are undone.
  /// @return the places
  /// @throws FileError if a place is taken by something that is no file, or a move fails
  std::vector<std::filesystem::path> publish();

 private:
  std::filesystem::path target_;
  std::filesystem::path directory_;
  std::vector<std::filesystem::path> made_directories_;  // outermost first
  std::vector<std::string> names_;
};

}  // namespace glissade::pipeline
