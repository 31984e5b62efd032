#pragma once

#include <cstdlib>

namespace testing {

/// @return true where a test with a heavy oracle is to try all of its cases instead of a part: in continuous integration,
///         or with the environment variable CI set
inline bool thorough() {
  return std::getenv("CI") != nullptr;
}

}  // namespace testing
