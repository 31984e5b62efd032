#pragma once

#include <filesystem>
#include <vector>

namespace glissade::io {

/// Makes a directory and those that it lies in.
/// @return those that had to be made, outermost first
/// @throws FileError
std::vector<std::filesystem::path> make_directories(const std::filesystem::path& target);

/// Moves that can be taken back: what is not committed is undone when this is destroyed.
class Moves {
 public:
  Moves() = default;
  Moves(const Moves&) = delete;
  Moves& operator=(const Moves&) = delete;
  ~Moves();

  void commit();

  /// Takes a file out of the way, to be gone with the attic.
  /// @param attic  a directory on the same file system
  void remove(const std::filesystem::path& file, const std::filesystem::path& attic);

  void move(const std::filesystem::path& from, const std::filesystem::path& to);

  /// Puts a new file in its place; an old one is replaced without a moment in which there is none.
  /// @param attic  as of remove(): what was there is kept in it
  /// @throws FileError if it cannot be put there
  void put(const std::filesystem::path& from, const std::filesystem::path& place,
           const std::filesystem::path& attic);

 private:
  struct Move {
    std::filesystem::path from;
    std::filesystem::path to;
    bool is_new;  // there was nothing at `from`
  };
  [[nodiscard]] std::filesystem::path next_in(const std::filesystem::path& attic) const;

  std::vector<Move> done_;
  std::vector<std::filesystem::path> made_;  // directories, outermost first
};

}  // namespace glissade::io
