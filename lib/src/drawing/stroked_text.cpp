#include "glissade/drawing/drawing.hpp"

#include "drawing/glyphs.hpp"

#include <string>
#include <utility>
#include <vector>

namespace glissade {

double stroked_width(const std::string& text, double height) {
  const std::vector<char32_t> characters = drawing::characters_of(text);
  if (characters.empty()) return 0.0;
  double width = -drawing::kLetterSpacing;
  for (const char32_t character : characters) {
    width += drawing::glyph_of(character).width + drawing::kLetterSpacing;
  }
  return width * height / drawing::kCapitalHeight;
}

std::vector<ArcPath> stroked_text(const std::string& text, Vec2 at, double height, Angle angle,
                                  TextAnchor anchor) {
  const double unit = height / drawing::kCapitalHeight;
  const double share = anchor == TextAnchor::left ? 0.0 : anchor == TextAnchor::centre ? 0.5 : 1.0;
  const PlaneMotion motion = PlaneMotion::turn(angle.radians(), at);
  std::vector<ArcPath> strokes;
  double pen = -share * stroked_width(text, height);
  for (const char32_t character : drawing::characters_of(text)) {
    const drawing::Glyph& glyph = drawing::glyph_of(character);
    for (const ArcPath& stroke : glyph.strokes) {
      ArcPath placed = scaled(stroke, unit);
      for (PathVertex& vertex : placed.vertices) vertex.at = motion(vertex.at + Vec2{pen, 0.0});
      strokes.push_back(std::move(placed));
    }
    pen += (glyph.width + drawing::kLetterSpacing) * unit;
  }
  return strokes;
}

}  // namespace glissade
