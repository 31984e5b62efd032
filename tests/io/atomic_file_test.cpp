#include "glissade/io/atomic_file.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/unfinished.hpp"

#include "support/catch.hpp"
#include "support/file_size_limit.hpp"
#include "support/temp_dir.hpp"

#include <filesystem>
#include <string>
#include <vector>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace atomic_file_test {

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

void write_text(const std::filesystem::path& file, const std::string& text) {
  AtomicFile output(file);
  output.write(text);
  output.commit();
}

std::string refusal(const std::filesystem::path& file) {
  try {
    write_text(file, "text");
  } catch (const FileError& error) {
    return error.what();
  }
  return "no refusal";
}

mode_t mode_of(const std::filesystem::path& file) {
  struct stat status {};
  REQUIRE(::stat(file.c_str(), &status) == 0);
  return status.st_mode & 0777U;
}

}  // namespace

TEST_CASE("a committed file holds what was written, in any block sizes") {
  const TempDir dir;
  std::string expected;
  {
    AtomicFile file(dir / "out.txt");
    for (const std::size_t size : {1UL, 100'000UL, 262'143UL, 1UL, 262'144UL, 3'000'000UL, 0UL, 7UL}) {
      const std::string text(size, static_cast<char>('a' + expected.size() % 26));
      file.write(text);
      expected += text;
    }
    file.commit();
  }
  CHECK(bytes_of(dir / "out.txt") == expected);
  CHECK(dir.names() == std::vector<std::string>{"out.txt"});
}

TEST_CASE("nothing is seen of a file before its commit, and nothing is left without one") {
  const TempDir dir;
  put_bytes(dir / "out.txt", "old");
  {
    AtomicFile file(dir / "out.txt");
    file.write(std::string(1'000'000, 'x'));
    CHECK(bytes_of(dir / "out.txt") == "old");
    CHECK(dir.names().size() == 2);
  }
  CHECK(bytes_of(dir / "out.txt") == "old");
  CHECK(dir.names() == std::vector<std::string>{"out.txt"});
}

TEST_CASE("an exception on the way leaves the old file and no other") {
  const TempDir dir;
  put_bytes(dir / "out.txt", "old");
  const auto fail = [&dir] {
    AtomicFile file(dir / "out.txt");
    file.write("new");
    throw std::runtime_error("on the way");
  };
  CHECK_THROWS_AS(fail(), std::runtime_error);
  CHECK(bytes_of(dir / "out.txt") == "old");
  CHECK(dir.names() == std::vector<std::string>{"out.txt"});
}

TEST_CASE("a disk that is full leaves the old file and no other, and the message says so") {
  const TempDir dir;
  put_bytes(dir / "out.txt", "old");
  std::string message;
  {
    const FileSizeLimit limit(1'000'000);
    try {
      write_text(dir / "out.txt", std::string(5'000'000, 'x'));
    } catch (const FileError& error) {
      message = error.what();
    }
  }
  CHECK_THAT(message, Contains("out.txt: cannot write: File too large"));
  CHECK_THAT(message, Contains("Try: a coarser tolerance"));
  CHECK(bytes_of(dir / "out.txt") == "old");
  CHECK(dir.names() == std::vector<std::string>{"out.txt"});
}

TEST_CASE("a disk that is full at the last block is noticed by commit") {
  const TempDir dir;
  {
    const FileSizeLimit limit(10);
    AtomicFile file(dir / "out.txt");
    file.write("more than ten bytes");
    CHECK_THROWS_AS(file.commit(), FileError);
  }
  CHECK(dir.names().empty());
}

TEST_CASE("what a file was expected to hold changes nothing but the time that it takes") {
  const TempDir dir;
  for (const std::uint64_t expected :
       {std::uint64_t{0}, std::uint64_t{3}, std::uint64_t{1} << 20U, UINT64_MAX}) {
    AtomicFile file(dir / "out.txt");
    file.expect(expected);
    file.write("text");
    file.commit();
    CHECK(bytes_of(dir / "out.txt") == "text");
  }
}

TEST_CASE("a disk too small for what is expected says so when it is written") {
  const TempDir dir;
  {
    const FileSizeLimit limit(10);
    AtomicFile file(dir / "out.txt");
    file.expect(19);
    file.write("more than ten bytes");
    CHECK_THROWS_AS(file.commit(), FileError);
  }
  CHECK(dir.names().empty());
}

TEST_CASE("what cannot be written is refused with the system's reason and a hint") {
  const TempDir dir;
  CHECK_THAT(refusal(dir / "missing/out.txt"),
             Contains("No such file or directory") && Contains("directories must exist"));
  put_bytes(dir / "file", "");
  CHECK_THAT(refusal(dir / "file/out.txt"), Contains("Not a directory"));
  CHECK_THAT(refusal(dir.path()), Contains("Is a directory"));
  CHECK_THAT(refusal(dir.path() / ""), Contains("Is a directory"));
  CHECK_THAT(refusal(""), Contains("Is a directory") || Contains("No such file"));
  CHECK_THAT(refusal("/dev/null"), Contains("not a regular file"));
  CHECK_THAT(refusal(dir / std::string(300, 'n')), Contains("File name too long"));
  std::filesystem::create_symlink("loop", dir / "loop");
  CHECK_THAT(refusal(dir / "loop"), Contains("symbolic links"));
  CHECK(dir.names() == std::vector<std::string>{"file", "loop"});
}

TEST_CASE("a protected directory and a protected file are refused") {
  // To the superuser nothing is protected: such a run tries it as another user in a child process.
  const TempDir dir;
  std::filesystem::create_directory(dir / "closed");
  put_bytes(dir / "kept.txt", "old");
  REQUIRE(::chmod(dir.path().c_str(), 0777) == 0);
  REQUIRE(::chmod((dir / "closed").c_str(), 0555) == 0);
  REQUIRE(::chmod((dir / "kept.txt").c_str(), 0444) == 0);
  const uid_t user = ::geteuid();
  constexpr uid_t kNobody = 65534;
  if (user == 0) REQUIRE(::seteuid(kNobody) == 0);
  const std::string closed = refusal(dir / "closed/out.txt");
  if (user == 0) REQUIRE(::seteuid(user) == 0);
  CHECK_THAT(closed, Contains("Permission denied") && Contains("Try: a place where you have the permission"));
  if (user != 0) CHECK_THAT(refusal(dir / "kept.txt"), Contains("cannot replace: Permission denied"));
  CHECK(bytes_of(dir / "kept.txt") == "old");
}

TEST_CASE("a new file follows the umask, a replaced one keeps its permissions") {
  const TempDir dir;
  const mode_t mask = ::umask(0027);
  write_text(dir / "new.txt", "text");
  CHECK(mode_of(dir / "new.txt") == 0640);
  put_bytes(dir / "old.txt", "old");
  REQUIRE(::chmod((dir / "old.txt").c_str(), 0604) == 0);
  write_text(dir / "old.txt", "text");
  CHECK(mode_of(dir / "old.txt") == 0604);
  ::umask(mask);
}

TEST_CASE("a symbolic link stays and the file behind it is replaced") {
  const TempDir dir;
  std::filesystem::create_directory(dir / "store");
  put_bytes(dir / "store/real.txt", "old");
  std::filesystem::create_symlink("store/real.txt", dir / "link.txt");
  std::filesystem::create_symlink("link.txt", dir / "second.txt");
  std::filesystem::create_symlink("store/later.txt", dir / "dangling.txt");
  write_text(dir / "second.txt", "new");
  write_text(dir / "dangling.txt", "later");
  CHECK(std::filesystem::is_symlink(dir / "link.txt"));
  CHECK(bytes_of(dir / "store/real.txt") == "new");
  CHECK(bytes_of(dir / "store/later.txt") == "later");
  CHECK(dir.names() == std::vector<std::string>{"dangling.txt", "link.txt", "second.txt", "store"});
}

TEST_CASE("a name of the longest length that the system takes can be written") {
  const TempDir dir;
  write_text(dir / std::string(255, 'n'), "text");
  CHECK(bytes_of(dir / std::string(255, 'n')) == "text");
}

TEST_CASE("a file name without a directory is in the current one") {
  const TempDir dir;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(dir.path());
  write_text("plain.txt", "text");
  std::filesystem::current_path(before);
  CHECK(bytes_of(dir / "plain.txt") == "text");
}

TEST_CASE("use after commit is a defect of the caller") {
  const TempDir dir;
  AtomicFile file(dir / "out.txt");
  file.commit();
  CHECK_THROWS_AS(file.write("more"), InternalError);
  CHECK_THROWS_AS(file.commit(), InternalError);
  CHECK(bytes_of(dir / "out.txt").empty());
}

TEST_CASE("what killed processes left goes with the next file of its directory, what others write stays") {
  const TempDir dir;
  put_bytes(dir / ".glissade-4194303-7.part", "left behind");
  put_bytes(dir / ".glissade-notes.part", "somebody's own");
  AtomicFile here(dir / "a.txt");
  here.write("a");
  CHECK_FALSE(std::filesystem::exists(dir / ".glissade-4194303-7.part"));
  CHECK(std::filesystem::exists(dir / ".glissade-notes.part"));
  // As another process would: the one that is being written is locked.
  AtomicFile::remove_abandoned(dir.path());
  here.commit();
  CHECK(bytes_of(dir / "a.txt") == "a");
  CHECK(dir.names().size() == 2);
}

TEST_CASE("a program that ends takes away what is not finished") {
  const TempDir dir;
  // In a process of its own: nothing is given its name after that.
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    AtomicFile finished(dir / "finished.txt");
    finished.write("whole");
    finished.commit();
    AtomicFile half(dir / "half.txt");
    half.write("half");
    std::filesystem::create_directories(dir / "made" / "new");
    put_bytes(dir / "made" / "new" / "x", "x");
    std::filesystem::create_directories(dir / "kept");
    std::filesystem::create_directories(dir / "empty");
    put_bytes(dir / "kept" / "own", "own");
    const Unfinished made(dir / "made");
    const Unfinished kept(dir / "kept", Unfinished::Kind::if_empty);
    const Unfinished empty(dir / "empty", Unfinished::Kind::if_empty);
    discard_unfinished();
    ::_exit(0);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(dir.names() == std::vector<std::string>{"finished.txt", "kept"});
}

}  // namespace atomic_file_test
