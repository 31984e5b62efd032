#pragma once

#include <string_view>

namespace glissade::study {

/// @return the text without blanks, tabs and carriage returns at its ends
inline std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t\r");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t\r") + 1 - from);
}

}  // namespace glissade::study
