#include "io/byte_source.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/stop.hpp"

#include "io/system_error.hpp"

#include <cerrno>
#include <string>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace glissade::io {
namespace {

/// @return size of the regular file behind `descriptor`
std::uint64_t size_of_regular(const std::filesystem::path& file, int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) throw system_error(file, "cannot read", errno);
  if (S_ISDIR(status.st_mode)) throw system_error(file, "cannot read", EISDIR);
  if (!S_ISREG(status.st_mode)) {
    throw FileError({file.string(), "cannot read: not a regular file",
                     "The size of a device or pipe is not known beforehand.", "to save it as a file first"});
  }
  return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace

// Without O_NONBLOCK the opening of a pipe would wait for its writer.
FileSource::FileSource(std::filesystem::path file, std::stop_token stop)
    : file_(std::move(file)),
      stop_(std::move(stop)),
      descriptor_(::open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) throw system_error(file_, "cannot read", errno);
  try {
    size_ = size_of_regular(file_, descriptor_);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

FileSource::~FileSource() {
  ::close(descriptor_);
}

std::size_t FileSource::read(char* buffer, std::size_t count) {
  require_going(stop_);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t got = ::read(descriptor_, buffer + done, count - done);
    if (got == 0) break;
    if (got > 0) {
      done += static_cast<std::size_t>(got);
    } else if (errno != EINTR) {
      throw system_error(file_, "cannot read", errno);
    }
  }
  return done;
}

std::string whole_text(const std::filesystem::path& file, std::uint64_t most) {
  FileSource source(file);
  if (source.size() > most) {
    throw FileError({file.string(), "has " + std::to_string(source.size()) + " bytes",
                     "At most " + std::to_string(most) + " are read.", ""});
  }
  std::string text(source.size(), '\0');
  text.resize(source.read(text.data(), text.size()));
  return text;
}

}  // namespace glissade::io
