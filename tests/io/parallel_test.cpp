// Work for several cores.

#include "io/parallel.hpp"

#include "support/catch.hpp"

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using glissade::io::each_in_turn;

TEST_CASE("each is begun in its order and worked on once") {
  for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
    std::vector<std::size_t> begun;
    std::vector<std::atomic<int>> worked(count);
    each_in_turn(
        count, [&](std::size_t i) { begun.push_back(i); }, [&](std::size_t i) { ++worked[i]; });
    REQUIRE(begun.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(begun[i] == i);
      CHECK(worked[i] == 1);
    }
  }
}

TEST_CASE("where several fail, the first of them is told, and none is begun after it is known") {
  for (const bool in_begin : {true, false}) {
    std::atomic<int> worked = 0;
    const auto fail_from = [&](std::size_t i) {
      if (i >= 100) throw std::runtime_error(std::to_string(i));
    };
    const auto all = [&] {
      each_in_turn(
          100000, [&](std::size_t i) { in_begin ? fail_from(i) : void(); },
          [&](std::size_t i) {
            ++worked;
            if (!in_begin) fail_from(i);
          });
    };
    CHECK_THROWS_WITH(all(), "100");
    CHECK(worked < 1000);
  }
}

}  // namespace
