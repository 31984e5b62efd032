#pragma once

namespace glissade::core {

inline constexpr double kMillimetres = 1000.0;  // in a metre

}  // namespace glissade::core
