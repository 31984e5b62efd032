#include "design/read_text.hpp"

#include "glissade/core/error.hpp"

#include <cstddef>
#include <fstream>
#include <system_error>

namespace glissade::design_file {
namespace {

constexpr std::size_t kLargestFile = std::size_t{4} << 20U;

}  // namespace

std::string read_text(const std::filesystem::path& file, std::string_view what, std::string_view maker) {
  const auto throw_unreadable = [&](const std::string& why, const std::string& hint) {
    throw FileError({file.string(), "cannot read " + std::string(what) + ": " + why, "", hint});
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  // What lies in a directory that may not be entered may well be there.
  if (status.type() == std::filesystem::file_type::none) {
    throw_unreadable(error.message(), "its path, and the permissions of the directories in it");
  }
  if (!std::filesystem::exists(status)) {
    throw_unreadable("no such file", "its path; " + std::string(maker));
  }
  if (std::filesystem::is_directory(status))
    throw_unreadable("it is a directory", "the path of a file in it");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw_unreadable("opening it is refused", "its permissions");
  // Read at most one byte more than the limit: the size of a pipe or a device is not known before.
  std::string text(kLargestFile + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw_unreadable("reading fails", "");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kLargestFile) {
    throw FileError({file.string(), "larger than 4 MiB", "Such a file is a page of text.",
                     "kind: points with a CSV file for a measured profile"});
  }
  return text;
}

}  // namespace glissade::design_file
