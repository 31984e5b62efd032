#pragma once

#include <limits>

namespace glissade::core {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();  // from 1 to the next number

}  // namespace glissade::core
