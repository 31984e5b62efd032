#pragma once

#include "glissade/core/arc_path.hpp"

#include <string_view>
#include <vector>

namespace glissade::drawing {

/// Capital letters of the glyphs are so high; small ones 7, and they reach 3 below the base line.
inline constexpr double kCapitalHeight = 10.0;
/// Between two glyphs.
inline constexpr double kLetterSpacing = 2.2;
/// Width of the pen that suits the glyphs (ISO 3098 type B: a tenth of the height).
inline constexpr double kPenWidth = 1.0;

struct Glyph {
  double width = 0.0;  ///< without the spacing
  std::vector<ArcPath> strokes;
};

/// @return the strokes of a character, an empty box where it has none
[[nodiscard]] const Glyph& glyph_of(char32_t character);

/// @return whether glyph_of() has more than a box
[[nodiscard]] bool has_glyph(char32_t character);

/// @return the characters of a UTF-8 text; U+FFFD for what is not
[[nodiscard]] std::vector<char32_t> characters_of(std::string_view text);

}  // namespace glissade::drawing
