#pragma once

#include <limits>

namespace glissade {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();  // from 1 to the next number

}  // namespace glissade
