#pragma once

#include "glissade/core/error.hpp"
#include "glissade/io/unfinished.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace glissade::io {

/// Writes a file that gets its own name later; in what goes wrong it has that name already.
template <typename Write>
void named_as(const std::filesystem::path& staged, const std::filesystem::path& file, Write&& write) {
  try {
    std::forward<Write>(write)();
  } catch (const FileError& error) {
    std::vector<Issue> issues = error.issues();
    for (Issue& issue : issues) {
      if (issue.where == staged.string()) issue.where = file.string();
    }
    throw FileError(std::move(issues));
  }
}

/// @return a descriptor that holds the lock on a directory until it is closed; -1 if another holds it (errno is EWOULDBLOCK), or
///         the file system has no locks
[[nodiscard]] int locked_directory(const std::filesystem::path& directory);

/// A hidden directory beside the places of files, in which they are made before they move there; gone with all that it holds
/// when this is destroyed, or when the program ends by a signal.
///
/// It is locked while it is in use: what killed processes left is what nobody has locked.
class StagingFolder {
 public:
  /// @param target  where the files will be
  /// @param error   why none can be made there; then this is not to be used
  StagingFolder(const std::filesystem::path& target, std::error_code& error);
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// What the places held before: it can be put back until all is done.
  [[nodiscard]] std::filesystem::path attic() const { return path_ / "old"; }
  /// @param name  of a file, relative to its target; folders in it are made
  /// @return where to make it
  [[nodiscard]] std::filesystem::path path_for(const std::filesystem::path& name, std::error_code& error);

 private:
  std::filesystem::path path_;
  int lock_ = -1;
  std::optional<Unfinished> unfinished_;
};

/// Removes what killed processes left of such directories: those of the name that StagingFolder gives, and of no other, that
/// nobody has locked.
void remove_abandoned_folders(const std::filesystem::path& target);

}  // namespace glissade::io
