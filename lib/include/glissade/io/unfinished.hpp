#pragma once

#include <filesystem>
#include <mutex>

namespace glissade {

/// What is being written and has not its own name yet: known to the process, so that one that is about to end can take
/// it away. All of it may be called from any thread.
class Unfinished {
 public:
  enum class Kind {
    whole,    ///< a file, or a directory with all that it holds
    if_empty  ///< a directory that was made, and goes only if nothing is in it
  };

  explicit Unfinished(std::filesystem::path path, Kind kind = Kind::whole);
  /// Forgets it: it is gone, or has its own name.
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  /// While it is held, discard_unfinished() waits: what stands half in its place is finished or taken back first.
  [[nodiscard]] static std::unique_lock<std::recursive_mutex> hold();

 private:
  std::filesystem::path path_;
};

/// Takes away everything unfinished, for a program that then ends at once (std::_Exit): nothing is given its name any
/// more, who tries waits for the end. Files that have their names stay.
/// Cost: waits for files that are being put in their places, some renames.
void discard_unfinished();

}  // namespace glissade
