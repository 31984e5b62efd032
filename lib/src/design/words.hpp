#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glissade::design_file {

/// @return the candidate that `word` is most likely a slip of; empty if none is near
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            const std::vector<std::string_view>& candidates);

/// @return "a, b and c", with `last` in the place of "and"
[[nodiscard]] std::string listed(const std::vector<std::string_view>& words, std::string_view last = "and");

/// @return `text` fit for a message: at most 60 characters, control characters shown as spaces
[[nodiscard]] std::string shown(std::string_view text);

}  // namespace glissade::design_file
