#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace glissade {

/// The frictions of a range that are looked at: its ends and the nominal one between them.
enum class FrictionLevel { low, nominal, high };

inline constexpr std::array<FrictionLevel, 3> kFrictionLevels = {FrictionLevel::low, FrictionLevel::nominal,
                                                                 FrictionLevel::high};

/// @return "low", "nominal", "high"
[[nodiscard]] constexpr std::string_view to_text(FrictionLevel level) {
  constexpr std::array<std::string_view, 3> kTexts = {"low", "nominal", "high"};
  return kTexts[static_cast<std::size_t>(level)];
}

}  // namespace glissade
