// Files that take their places together.

#include "glissade/io/file_set.hpp"

#include "glissade/core/error.hpp"
#include "glissade/io/atomic_file.hpp"
#include "glissade/io/unfinished.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace glissade;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

}  // namespace

TEST_CASE("files of a set appear together, with the permissions and links of those that they replace") {
  const TempDir place;
  put_bytes(place / "old.txt", "old");
  REQUIRE(::chmod((place / "old.txt").c_str(), 0640) == 0);
  fs::create_symlink("old.txt", place / "link.txt");
  {
    FileSet files;
    files.put(place / "link.txt", "new");
    files.put(place / "other.txt", "other");
    CHECK(bytes_of(place / "old.txt") == "old");
    CHECK_FALSE(fs::exists(place / "other.txt"));
    files.commit();
  }
  CHECK(place.names() == std::vector<std::string>{"link.txt", "old.txt", "other.txt"});
  CHECK(fs::is_symlink(place / "link.txt"));
  CHECK(bytes_of(place / "old.txt") == "new");
  CHECK(bytes_of(place / "other.txt") == "other");
  CHECK(fs::status(place / "old.txt").permissions() == fs::perms(0640));
}

TEST_CASE("a set puts files beside each other in the directory in which the program runs") {
  const TempDir place;
  const fs::path before = fs::current_path();
  fs::current_path(place.path());
  {
    FileSet files;
    files.put("a.txt", "new");
    files.put("./b.txt", "new");
    files.commit();
  }
  fs::current_path(before);
  CHECK(place.names() == std::vector<std::string>{"a.txt", "b.txt"});
}

TEST_CASE("where one file of a set cannot be put in its place, those before it are taken back") {
  const TempDir place;
  put_bytes(place / "b.txt", "old");
  {
    FileSet files;
    files.put(place / "a.txt", "new");
    files.put(place / "b.txt", "new");
    files.put(place / "c.txt", "new");
    fs::create_directories(place / "c.txt" / "in the way");
    CHECK_THROWS_AS(files.commit(), FileError);
  }
  CHECK(place.names() == std::vector<std::string>{"b.txt", "c.txt"});
  CHECK(bytes_of(place / "b.txt") == "old");
}

TEST_CASE("a set that is not committed leaves nothing, and tells of a file by the name that was asked for") {
  const TempDir place;
  FileSet files;
  files.put(place / "a.txt", "new");
  CHECK_THROWS_WITH(files.put(place / "none" / "b.txt", "new"),
                    Contains("none/b.txt: cannot create a file in its directory: No such file"));
  CHECK_THROWS_WITH(files.put("/dev/null", "new"), Contains("/dev/null: cannot write: not a regular file"));
  CHECK_THROWS_WITH(files.make(place / "c.txt",
                               [](const fs::path& made) {
                                 throw FileError({made.string(), "went wrong", "", ""});
                               }),
                    Contains((place / "c.txt").string() + ": went wrong"));
}

TEST_CASE("a program that ends while files take their places leaves all of them, or none") {
  constexpr int kFiles = 60;
  for (int round = 0; round < 20; ++round) {
    INFO("round " << round);
    const TempDir place;
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      std::thread worker([&] {
        try {
          FileSet files;
          for (int i = 0; i < kFiles; ++i) files.put(place / ("f" + std::to_string(i)), "text");
          files.commit();
        } catch (const std::exception&) {
          return;  // its directory is gone
        }
      });
      std::this_thread::sleep_for(std::chrono::microseconds(200 * round));
      discard_unfinished();
      ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    const std::size_t there = place.names().size();
    CHECK((there == 0 || there == kFiles));
  }
}

TEST_CASE("whoever writes a file clears what killed processes left in its directory") {
  const TempDir place;
  fs::create_directories(place / ".glissade-4194303-7" / "new");
  put_bytes(place / ".glissade-4194303-7" / "new" / "a", "left behind");
  fs::create_directories(place / ".glissade-notes");
  write_atomically(place / "a.txt", "new");
  CHECK(place.names() == std::vector<std::string>{".glissade-notes", "a.txt"});
}
