#pragma once

#include "glissade/io/unfinished.hpp"

#include "io/staging_folder.hpp"

#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glissade::pipeline {

/// What a set of files changed in its directory.
struct Published {
  std::vector<std::filesystem::path> files;    ///< in the order in which they were asked for
  std::vector<std::filesystem::path> removed;  ///< of an earlier set of the same owner, unchanged since
  /// Files that stood in the way and were not ours, by the names that they have now.
  std::vector<std::filesystem::path> set_aside;
};

/// @throws FileError if the target holds files of this owner that were built from another design, which is still there:
///         designs of one name in different directories do not replace each other's files unasked
void require_same_design(const std::filesystem::path& target, const std::string& owner,
                         const std::filesystem::path& design);

/// A directory inside the target directory in which the files of one owner are made and checked before all of
/// them move to their places together. What has not been published is gone when this is destroyed, the target
/// directory too where it was made for this and stayed empty.
///
/// The directory is locked while it is in use; whoever writes next in the same target removes those that nobody
/// has locked, which killed processes left behind.
class Staging {
 public:
  /// @param target  where the files will be; made if missing
  /// @param owner   whose files they are, e.g. the stem of a design's file name
  /// @param design  the design file that they are built from; may be empty or no file
  /// @throws FileError if `target` cannot be made or written to, or as require_same_design()
  Staging(const std::filesystem::path& target, std::string owner, const std::filesystem::path& design);
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// Has publish() leave files of an earlier set in their places, whether or not the new set has them.
  /// @param stays  asked of each that would be removed
  void keep(std::function<bool(const std::filesystem::path&)> stays) { stays_ = std::move(stays); }

  /// @param name  of a file, relative to the target; folders in it are made
  /// @return where to make the file that will be called `name`
  [[nodiscard]] std::filesystem::path path_for(const std::string& name);

  /// Makes the file that will be called `name`; what goes wrong says so of that name.
  /// @param write  gets where to make it
  template <typename Write>
  void make(const std::string& name, Write&& write) {
    const std::filesystem::path staged = path_for(name);
    io::named_as(staged, target_ / name, [&] { write(staged); });
  }

  /// Moves every file to its place. An earlier file of the same owner is replaced, and removed where the new set
  /// lacks it; any other file that stands in the way keeps its bytes under a new name, NAME.kept. Should one move
  /// fail, those before it are undone.
  /// @throws FileError if a place is taken by something that is no file, or by what a build of another design wrote that
  ///   is still there, or a move fails
  Published publish();

 private:
  void require_of_no_other(const std::vector<std::string>& in_the_way) const;

  std::filesystem::path target_;
  std::string owner_;
  std::filesystem::path design_;                         // relative to the target
  std::vector<std::filesystem::path> made_directories_;  // outermost first
  std::list<Unfinished> unfinished_directories_;
  std::optional<io::StagingFolder> folder_;
  std::vector<std::string> names_;
  std::function<bool(const std::filesystem::path&)> stays_;
};

}  // namespace glissade::pipeline
