// The directory in which a build makes its files, when the program ends.

#include "pipeline/files/staging.hpp"

#include "glissade/io/atomic_file.hpp"
#include "glissade/io/unfinished.hpp"

#include "support/catch.hpp"
#include "support/temp_dir.hpp"

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

using namespace glissade;

TEST_CASE("what a program takes away at its end is not made again by threads that are still at work") {
  const TempDir place;
  for (int round = 0; round < 20; ++round) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      pipeline::Staging staging(place.path(), "d", "");
      std::thread worker([&] {
        for (int i = 0;; ++i) {
          try {
            write_atomically(staging.path_for("d.parts/" + std::to_string(i)), "part");
          } catch (const std::exception&) {
            continue;  // its directory is gone
          }
        }
      });
      std::this_thread::sleep_for(std::chrono::milliseconds(2 + round % 5));
      discard_unfinished();
      // A program has more to do before it is gone: it tells what happened.
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
      ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(place.names() == std::vector<std::string>{});
  }
}

TEST_CASE("builds of one design at once take turns: none sets aside what another has just written") {
  const TempDir place;
  constexpr int kRounds = 15;
  constexpr int kFiles = 80;
  std::vector<pid_t> children;
  for (int build = 0; build < 3; ++build) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      int faults = 0;
      for (int round = 0; round < kRounds; ++round) {
        try {
          pipeline::Staging staging(place.path(), "d", "");
          for (int i = 0; i < kFiles; ++i) {
            write_atomically(staging.path_for("d." + std::to_string(i)),
                             std::to_string(build) + " in round " + std::to_string(round));
          }
          faults += static_cast<int>(staging.publish().set_aside.size());
        } catch (const std::exception&) {
          ++faults;
        }
      }
      ::_exit(faults == 0 ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
  const std::vector<std::string> names = place.names();
  CHECK(names.size() == kFiles + 1);
  for (const std::string& name : names) CHECK(name.find(".kept") == std::string::npos);
}
