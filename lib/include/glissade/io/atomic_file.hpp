#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace glissade {

/// A file that appears whole or not at all: bytes go to a sibling, commit() flushes and renames it over the
/// target. Destruction without commit() removes the sibling and leaves the target as it was.
class AtomicFile {
 public:
  /// @throws FileError if the sibling cannot be created (says which directory and why)
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @throws FileError if the bytes cannot be written, e.g. on a full disk
  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }

  /// @throws FileError if flushing or renaming fails
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace glissade
