#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace glissade {

/// The frictions of a range that are looked at: its ends, the nominal one between them, and where something is greatest at none
/// of these one in between.
enum class FrictionLevel { low, nominal, high, between };

/// Those that every range has.
inline constexpr std::array<FrictionLevel, 3> kFrictionLevels = {FrictionLevel::low, FrictionLevel::nominal,
                                                                 FrictionLevel::high};

/// @return "low", "nominal", "high", "in-between"
[[nodiscard]] constexpr std::string_view to_text(FrictionLevel level) {
  constexpr std::array<std::string_view, 4> kTexts = {"low", "nominal", "high", "in-between"};
  return kTexts[static_cast<std::size_t>(level)];
}

}  // namespace glissade
