#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// @return "a, b and c", with `last` in the place of "and"
[[nodiscard]] std::string listed(const std::vector<std::string_view>& words, std::string_view last = "and");
[[nodiscard]] std::string listed(const std::vector<std::string>& words, std::string_view last = "and");

/// @return `text` fit for a message: at most 60 characters, control characters shown as spaces, characters that
///         cannot be seen by their number
[[nodiscard]] std::string shown(std::string_view text);

}  // namespace glissade
