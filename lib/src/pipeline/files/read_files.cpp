#include "pipeline/files/read_files.hpp"

#include "glissade/core/error.hpp"

#include <optional>
#include <system_error>

namespace glissade::pipeline {
namespace {

namespace fs = std::filesystem;

/// Whether two paths lead to one file, whether it is there or not.
bool is_one_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  return fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

/// The file that a design reads at a place; its key is empty of the design itself.
std::optional<DataFile> read_at(const Design& design, const fs::path& place) {
  if (!design.file.empty() && is_one_file(design.file, place)) return DataFile{design.file, {}};
  for (const DataFile& data : design.data_files) {
    if (is_one_file(data.file, place)) return data;
  }
  return std::nullopt;
}

std::string key_of(const DataFile& data) {
  return data.key_path.empty() ? "the design" : data.key_path;
}

}  // namespace

void require_none_read(const Design& design, const fs::path& directory,
                       const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::optional<DataFile> data = read_at(design, directory / name);
    if (!data) continue;
    throw InputError({data->key_path.empty() ? design.file.string() : design.where(data->key_path),
                      key_of(*data) + ": " + data->file.string() + " is read by this command, too",
                      "Files are called after their design: " + name + " would take its place in " +
                          directory.string() + ", and what it holds would be lost.",
                      "another directory, or another name for " + data->file.filename().string()});
  }
}

bool is_read_by(const Design& design, const fs::path& file) {
  return read_at(design, file).has_value();
}

}  // namespace glissade::pipeline
