#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

namespace glissade {

/// Files that take their places together: all of them, or none.
///
/// Each is made in a hidden directory beside its place; commit() moves them there. Where one move fails, those before it are
/// taken back, and what the files replaced is there again. Destruction without commit() leaves every place as it was, and so does
/// discard_unfinished() at any moment; while files are being put in their places it waits until all are. What a target may be, and
/// what becomes of its permissions and links, is as of AtomicFile.
class FileSet {
 public:
  FileSet();
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Makes a file; what goes wrong says so of that name.
  /// @param write  gets where to make it, a path that ends in the same name
  /// @throws FileError if the target is not replaceable or no file can be made beside it; whatever `write` throws
  void make(const std::filesystem::path& target,
            const std::function<void(const std::filesystem::path&)>& write);

  /// The same of a text that is there.
  void put(const std::filesystem::path& target, std::string_view bytes);

  /// @throws FileError if one cannot be put in its place; then none is
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade
