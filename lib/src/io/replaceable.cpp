#include "io/replaceable.hpp"

#include "glissade/core/error.hpp"

#include "io/system_error.hpp"

#include <cerrno>
#include <system_error>

#include <sys/stat.h>
#include <unistd.h>

namespace glissade::io {
namespace {

/// @return the file that the target means: the target itself or what its symbolic links lead to
std::filesystem::path without_links(const std::filesystem::path& target) {
  constexpr int kMostLinks = 40;  // taste: as many as Linux follows
  std::filesystem::path file = target;
  for (int i = 0; i < kMostLinks; ++i) {
    std::error_code failure;
    const std::filesystem::path next = std::filesystem::read_symlink(file, failure);
    if (failure) return file;
    file = next.is_absolute() ? next : file.parent_path() / next;
  }
  throw system_error(target, "cannot write", ELOOP);
}

/// @return permissions of the file that is about to be replaced; none if there is no such file
std::optional<mode_t> replaceable_mode(const std::filesystem::path& target,
                                       const std::filesystem::path& file) {
  struct stat status {};
  // Of the target, not of what its links are called: /dev/stdout leads to a pipe by a name that is none.
  if (::stat(target.c_str(), &status) != 0) {
    if (errno == ENOENT) return std::nullopt;
    throw system_error(target, "cannot write", errno);
  }
  if (S_ISDIR(status.st_mode)) throw system_error(target, "cannot write", EISDIR);
  if (!S_ISREG(status.st_mode)) {
    throw FileError({target.string(), "cannot write: not a regular file",
                     "A file is made beside its place and put there whole; a device or a pipe takes none.",
                     "the name of a file"});
  }
  if (::access(file.c_str(), W_OK) != 0) throw system_error(target, "cannot replace", errno);
  constexpr mode_t kPermissionBits = 0777;
  return status.st_mode & kPermissionBits;
}

}  // namespace

Replaceable replaceable(const std::filesystem::path& target) {
  if (!target.has_filename()) throw system_error(target, "cannot write", EISDIR);
  const std::filesystem::path file = without_links(target);
  return {file, replaceable_mode(target, file)};
}

}  // namespace glissade::io
