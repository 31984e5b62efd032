#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

namespace glissade {

/// A file that appears whole or not at all.
///
/// Bytes go to a sibling in the target's directory, commit() renames it over the target. Destruction without
/// commit() removes the sibling and leaves the target as it was. Where the target is a symbolic link, the
/// file it points to is replaced and the link stays. A new file gets the permissions that the umask leaves of
/// 0666; a replaced one keeps those it had. A target that is write-protected, a directory, a device or a pipe
/// is refused. What killed processes left is removed by the next file that is made in the directory.
///
/// What it promises holds against exceptions, full disks and broken processes, not against a loss of power:
/// nothing waits for the disk (no fsync), since every file of Glissade can be made again from its design.
class AtomicFile {
 public:
  /// @throws FileError if the sibling cannot be created or the target is not replaceable; says why
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Lets the file system set aside room for a file of this size, which makes writing it up to a third
  /// cheaper. An offer: where it cannot be had, write() goes on without, or says what is wrong.
  void expect(std::uint64_t bytes);

  /// @throws FileError if the bytes cannot be written, e.g. on a full disk
  /// @throws InternalError after commit()
  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// Removes what killed processes left in a directory, siblings and the folders in which files that belong together are made:
  /// those that nobody has locked.
  static void remove_abandoned(const std::filesystem::path& directory);

  /// @throws FileError if flushing, closing or renaming fails; the target is then untouched
  /// @throws InternalError if called twice
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A whole file at a time: created, written and renamed, or nothing of it.
/// @throws FileError as AtomicFile does
void write_atomically(const std::filesystem::path& target, std::string_view bytes);

}  // namespace glissade
