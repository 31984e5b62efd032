#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace glissade::pipeline {

/// The files that builds of one design wrote into a directory, by a list that lies beside them: a hidden file
/// `.NAME.sha256` as sha256sum writes and checks it.
///
/// A file is ours as long as its bytes are those that we wrote. What somebody made or changed himself is never
/// ours, whatever its name: a build neither removes it nor writes over it.
class OwnedFiles {
 public:
  /// @return name of the list of a design called `stem`
  [[nodiscard]] static std::string list_name(const std::string& stem);

  /// Reads the list of a design; where there is none, or none that can be read, nothing is ours. Names that
  /// lead out of the directory are left out.
  [[nodiscard]] static OwnedFiles in(const std::filesystem::path& directory, const std::string& stem);

  /// @return whether the file is listed, and is a regular file with the bytes that were written
  [[nodiscard]] bool unchanged(const std::string& name) const;

  [[nodiscard]] std::vector<std::string> names() const;

  /// @return the design that the list names, where that is still there and another file than `design`
  [[nodiscard]] std::optional<std::filesystem::path> other_design(const std::filesystem::path& design) const;

  /// @param names   relative to `directory`, where the files lie
  /// @param design  the file that they were built from, relative to where the list will lie; empty: none is named
  /// @return text of the list: the design in a comment, then a line a file, sorted by name
  /// @throws FileError if a file cannot be read
  [[nodiscard]] static std::string list_of(const std::filesystem::path& directory,
                                           const std::vector<std::string>& names,
                                           const std::filesystem::path& design);

 private:
  std::filesystem::path directory_;
  std::string design_;                            // relative to the directory
  std::map<std::string, std::string> checksums_;  // by name
};

}  // namespace glissade::pipeline
