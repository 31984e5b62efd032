#pragma once

#include <cstddef>

namespace glissade::bench {

/// @return how often this program has allocated with operator new so far
[[nodiscard]] std::size_t allocation_count() noexcept;

}  // namespace glissade::bench
