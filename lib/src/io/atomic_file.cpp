#include "glissade/io/atomic_file.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/unfinished.hpp"

#include "io/replaceable.hpp"
#include "io/staging_folder.hpp"
#include "io/system_error.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace glissade {

using namespace io;

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18U;
constexpr mode_t kNewFileMode = 0666;

}  // namespace

void AtomicFile::remove_abandoned(const std::filesystem::path& directory) {
  static const std::regex kName(R"(\.glissade-[0-9]+-[0-9]+\.part)");
  std::error_code error;
  const std::filesystem::path place = directory.empty() ? std::filesystem::path(".") : directory;
  for (auto entry = std::filesystem::directory_iterator(place, error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (!std::regex_match(entry->path().filename().string(), kName)) continue;
    const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    struct stat status {};
    const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    if (is_file && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(entry->path().c_str());
    ::close(descriptor);
  }
  remove_abandoned_folders(place);
}

namespace {

/// Once a directory: a sweep writes thousands of files into one.
void remove_abandoned_once(const std::filesystem::path& directory) {
  static std::mutex mutex;
  static std::set<std::filesystem::path> known;
  const std::scoped_lock lock(mutex);
  if (known.insert(directory).second) AtomicFile::remove_abandoned(directory);
}

/// @return whether the file is this process's own: no other takes it for abandoned, nor has done so
bool claimed(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

}  // namespace

struct AtomicFile::State {
  std::filesystem::path target;   ///< as the caller named it, for messages
  std::filesystem::path file;     ///< what is replaced
  std::filesystem::path sibling;  ///< what is written
  std::optional<mode_t> mode;     ///< to give it before it takes its place
  std::optional<Unfinished> unfinished;
  std::vector<char> buffer;
  int descriptor = -1;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (descriptor >= 0) ::close(descriptor);
    if (!sibling.empty()) ::unlink(sibling.c_str());
  }

  void create_sibling() {
    remove_abandoned_once(file.parent_path());
    static std::atomic<unsigned> counter{0};
    constexpr int kMostTries = 1000;
    for (int i = 0; i < kMostTries; ++i) {
      const std::string name =
          ".glissade-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".part";
      const std::filesystem::path path = file.parent_path() / name;
      // A program that ends meanwhile knows of the file, or waits with it for good.
      const auto hold = Unfinished::hold();
      descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode);
      if (descriptor >= 0 && claimed(descriptor)) {
        sibling = path;
        unfinished.emplace(path);
        return;
      }
      if (descriptor >= 0) {
        ::close(std::exchange(descriptor, -1));
        continue;
      }
      if (errno != EEXIST && errno != EINTR) break;
    }
    throw system_error(target, "cannot create a file in its directory", errno);
  }

  void write_through(const char* bytes, std::size_t count) const {
    while (count > 0) {
      const ssize_t written = ::write(descriptor, bytes, count);
      if (written < 0) {
        if (errno == EINTR) continue;
        throw system_error(target, "cannot write", errno);
      }
      bytes += written;
      count -= static_cast<std::size_t>(written);
    }
  }

  void flush() {
    write_through(buffer.data(), buffer.size());
    buffer.clear();
  }
};

AtomicFile::AtomicFile(std::filesystem::path target) : state_(std::make_unique<State>()) {
  state_->target = std::move(target);
  const Replaceable replaced = replaceable(state_->target);
  state_->file = replaced.file;
  state_->mode = replaced.mode;
  state_->buffer.reserve(kBufferSize);
  state_->create_sibling();
}

AtomicFile::~AtomicFile() = default;

void AtomicFile::expect(std::uint64_t bytes) {
#ifdef FALLOC_FL_KEEP_SIZE
  (void)::fallocate(state_->descriptor, FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(bytes));
#else
  (void)bytes;
#endif
}

void AtomicFile::write(const void* bytes, std::size_t count) {
  if (state_->descriptor < 0)
    throw InternalError({state_->target.string(), "written to after commit", "", ""});
  const char* text = static_cast<const char*>(bytes);
  if (state_->buffer.size() + count > kBufferSize) state_->flush();
  if (count >= kBufferSize) {
    state_->write_through(text, count);
  } else {
    state_->buffer.insert(state_->buffer.end(), text, text + count);
  }
}

void AtomicFile::commit() {
  if (state_->descriptor < 0) throw InternalError({state_->target.string(), "committed twice", "", ""});
  state_->flush();
  if (state_->mode && ::fchmod(state_->descriptor, *state_->mode) != 0) {
    throw system_error(state_->target, "cannot give it the permissions that it had", errno);
  }
  // The lock is held until it has its name: a copy of the descriptor keeps it.
  const int lock = ::fcntl(state_->descriptor, F_DUPFD_CLOEXEC, 0);
  const bool closed = ::close(std::exchange(state_->descriptor, -1)) == 0;
  int failure = closed ? 0 : errno;
  if (closed) {
    const auto hold = Unfinished::hold();
    if (::rename(state_->sibling.c_str(), state_->file.c_str()) != 0) failure = errno;
  }
  if (lock >= 0) ::close(lock);
  if (failure != 0) {
    throw system_error(state_->target, closed ? "cannot put the finished file in its place" : "cannot write",
                       failure);
  }
  state_->sibling.clear();
  state_->unfinished.reset();
}

void write_atomically(const std::filesystem::path& target, std::string_view bytes) {
  AtomicFile file(target);
  file.write(bytes);
  file.commit();
}

}  // namespace glissade
