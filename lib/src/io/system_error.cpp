#include "io/system_error.hpp"

#include <cerrno>
#include <system_error>

namespace glissade::io {
namespace {

std::string hint_for(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return "to free space, or a directory on another disk";
    case EFBIG:
      return "a coarser tolerance, or a directory whose files may grow larger (ulimit -f)";
    case EACCES:
    case EPERM:
      return "a place where you have the permission, or chmod";
    case EROFS:
      return "a directory that is not mounted read-only";
    case ENOENT:
      return "to check the path; directories must exist";
    case ENOTDIR:
      return "to check the path; one of its directories is a file";
    case EISDIR:
      return "the name of a file, not of a directory";
    case ENAMETOOLONG:
      return "a shorter name";
    case ELOOP:
      return "to check the symbolic links; they lead in a circle";
    case EMFILE:
    case ENFILE:
      return "fewer open files (ulimit -n)";
    default:
      return {};
  }
}

}  // namespace

FileError system_error(const std::filesystem::path& file, const std::string& what, int code) {
  return FileError({file.string(), what + ": " + std::generic_category().message(code), "", hint_for(code)});
}

}  // namespace glissade::io
