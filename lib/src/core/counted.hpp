#pragma once

#include <cstddef>
#include <string>

namespace glissade::core {

/// @param thing  one of them: "point"
/// @return a number of things for people: "1 point", "3 points"
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + ' ' + thing + (count == 1 ? "" : "s");
}

}  // namespace glissade::core
