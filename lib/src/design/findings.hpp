#pragma once

#include "glissade/core/error.hpp"
#include "glissade/design/design.hpp"

#include "design/notes.hpp"
#include "design/yaml_tree.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glissade::design_file {

/// One problem, with the values that it is about by their key paths; the first is the one to point at.
struct Finding {
  std::vector<std::string> key_paths;
  Issue issue;
};

/// What a reading has collected: problems, and where each key stands.
class Findings {
 public:
  Findings(std::filesystem::path file, const std::vector<Override>& overrides)
      : file_(std::move(file)), overrides_(overrides) {}

  void set_position(const std::string& key_path, Position position) { positions_[key_path] = position; }
  /// @return position of the key path or of its nearest parent that has one
  [[nodiscard]] Position position(std::string_view key_path) const;
  [[nodiscard]] std::string where(Position position) const;
  [[nodiscard]] std::map<std::string, std::string, std::less<>> locations() const;

  void add(Position position, std::string key_path, Issue issue);
  /// Adds that a file which the design names cannot be read, or is not of its format.
  void add_file(Position position, std::string key_path, Issue issue);
  /// Takes back what was said of a key that is not there: it is, misspelt.
  void withdraw(std::string_view key_path);
  /// Adds a problem between values, unless one of them has a problem of its own already.
  void add_unless_spoiled(Finding finding);

  /// @return whether there is a problem at the key path, below it or above it
  [[nodiscard]] bool spoiled(std::string_view key_path) const;

  /// Notes a file that the design names.
  void add_data_file(DataFile file) { data_files_.push_back(std::move(file)); }
  [[nodiscard]] const std::vector<DataFile>& data_files() const { return data_files_; }

  /// Has the reading note what it asks for; `notes` outlives this.
  void keep(Notes& notes) { notes_ = &notes; }
  [[nodiscard]] Notes* notes() const { return notes_; }

  [[nodiscard]] bool empty() const { return problems_.empty(); }
  /// @return whether there are problems, all of them those of add_file()
  [[nodiscard]] bool only_files() const {
    return !problems_.empty() && files_ == problems_.size() + left_out_;
  }
  /// @return the problems by position, with `where` filled in; beyond kMostReported only how many more there
  /// are
  [[nodiscard]] std::vector<Issue> issues() const;

 private:
  struct Problem {
    Position at;
    std::string key_path;
    Issue issue;
  };

  static constexpr std::size_t kMostReported = 100;

  std::filesystem::path file_;
  const std::vector<Override>& overrides_;
  std::map<std::string, Position, std::less<>> positions_;
  std::vector<Problem> problems_;
  std::vector<DataFile> data_files_;
  std::size_t left_out_ = 0;
  Notes* notes_ = nullptr;
  std::size_t files_ = 0;
};

/// @return the key path without its last part; empty for a top-level key
[[nodiscard]] std::string_view parent_path(std::string_view key_path);

}  // namespace glissade::design_file
