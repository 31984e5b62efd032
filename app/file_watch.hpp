#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <vector>

namespace glissade::app {

/// Which bytes a name stood for when it was looked at, as far as that shows without reading them.
struct FileStamp {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;   ///< another one where an editor put a new file in the place of the old
  std::int64_t size = 0;     ///< [bytes]
  std::int64_t changed = 0;  ///< [ns] since the epoch

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// @return none where there is no such file
[[nodiscard]] std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

/// Files that are looked at several times a second. That sees every way in which editors save (in place, or by
/// renaming a new file), on every file system, network ones included, and costs next to nothing.
class FileWatch {
 public:
  /// Looks at a file now; what changes from here on is a change.
  void add(const std::filesystem::path& file);
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  /// Waits until a file is another than when it was added, and none changes any more.
  /// @return false if `stop` ended it
  [[nodiscard]] bool wait(const std::stop_token& stop) const;

 private:
  using Stamps = std::vector<std::optional<FileStamp>>;
  [[nodiscard]] Stamps look() const;

  std::vector<std::filesystem::path> files_;
  Stamps stamps_;
};

}  // namespace glissade::app
