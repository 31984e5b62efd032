#pragma once

#include "glissade/parts/shop_part.hpp"

#include <cstddef>

namespace glissade {

/// @return how often a press hits a pattern: lines that an opening parts are one bend
[[nodiscard]] std::size_t bend_hits(const FlatPattern& pattern);

}  // namespace glissade
