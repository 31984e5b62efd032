#pragma once

namespace glissade {

inline constexpr double kMillimetres = 1000.0;  // in a metre

}  // namespace glissade
