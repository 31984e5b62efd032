#pragma once

#include <cstddef>
#include <string>

namespace glissade::core {

/// @return a count with its thousands apart, by a narrow space at which no line breaks: as the report's page writes its own
[[nodiscard]] inline std::string grouped(std::size_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, "\u202f");
  return text;
}

}  // namespace glissade::core
