#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace glissade::study {

/// @param index  from 0 on
/// @return the point of Sobol's sequence (Joe & Kuo's directions) as binary fractions of 64 bits, one a dimension
[[nodiscard]] std::vector<std::uint64_t> sobol_point(std::size_t dimensions, std::uint64_t index);

}  // namespace glissade::study
