#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace glissade::io {

/// Makes a name from a design fit for one line of any file: every control character and every byte that is
/// not UTF-8 becomes a space, and what exceeds `most_bytes` is cut off between two characters.
[[nodiscard]] std::string printable_name(std::string_view name, std::size_t most_bytes = 200);

}  // namespace glissade::io
