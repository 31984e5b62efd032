#include "drawing/extents.hpp"

#include "glissade/core/math.hpp"

#include "drawing/glyphs.hpp"

#include <algorithm>
#include <array>

namespace glissade::drawing {
namespace {

// Over the height of capital letters.
constexpr double kWidest = 1.0;  // measured: a character of "txt" with its gap; the usual fonts are narrower
constexpr double kBelow = 0.35;  // measured: what g, j and a comma have below the base line
constexpr double kAbove = 1.35;  // measured: capitals with an accent

/// Holds both, or the one that there is.
PlaneBox around(const std::optional<PlaneBox>& known, const PlaneBox& box) {
  if (!known) return box;
  return {{std::min(known->low.x, box.low.x), std::min(known->low.y, box.low.y)},
          {std::max(known->high.x, box.high.x), std::max(known->high.y, box.high.y)}};
}

}  // namespace

PlaneBox extents(const DrawnText& text, double scale) {
  const double height = text.height_mm / scale;
  const auto characters = static_cast<double>(characters_of(text.text).size());
  const double width = std::max(stroked_width(text.text, height), kWidest * characters * height);
  const double share = text.anchor == TextAnchor::left ? 0.0 : text.anchor == TextAnchor::centre ? 0.5 : 1.0;
  const auto [sine, cosine] = math::sine_cosine(text.angle.radians());
  std::optional<PlaneBox> box;
  for (const double x : {-share * width, (1.0 - share) * width}) {
    for (const double y : {-kBelow * height, kAbove * height}) {
      const Vec2 corner = text.at + Vec2{cosine * x - sine * y, sine * x + cosine * y};
      box = around(box, {corner, corner});
    }
  }
  return *box;
}

std::optional<PlaneBox> extents(const Drawing& drawing) {
  std::optional<PlaneBox> whole = bounds(drawing);
  const double scale = 1.0 / drawing.text_scale;
  const auto include = [&](const DrawnText& text) {
    if (!text.text.empty()) whole = around(whole, extents(text, scale));
  };
  for (const DrawnText& text : drawing.texts) include(text);
  for (const DrawnDimension& dimension : drawing.dimensions) {
    const DimensionLines drawn = lines_of(dimension, scale);
    for (const ArcPath& line : drawn.lines) whole = around(whole, bounds(line));
    for (const ArcPath& arrow : drawn.arrows) whole = around(whole, bounds(arrow));
    include(drawn.text);
  }
  return whole;
}

}  // namespace glissade::drawing
