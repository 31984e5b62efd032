#pragma once

#include "glissade/core/number_text.hpp"
#include "glissade/drawing/sheet.hpp"
#include "glissade/parts/shop_part.hpp"

#include "core/millimetres.hpp"

#include <cmath>
#include <string>
#include <utility>

/// What the sheets of a set say alike: lengths, numbers of parts, titles.
namespace glissade::drawing {

/// @return a length in millimetres, to a tenth; "-" of one that is not finite
inline std::string mm(double metres) {
  if (!std::isfinite(metres)) return "-";
  return decimal_text(std::round(metres * 1e4) / 10.0 + 0.0);
}

/// @return "07", "113"
inline std::string number_of(const ShopPart& part) {
  return (part.number < 10 ? "0" : "") + std::to_string(part.number);
}

inline TitleBlock title_of(const Workshop& workshop, std::string title) {
  TitleBlock block;
  block.title = std::move(title);
  block.owner = workshop.name;
  block.note = workshop.tolerance;
  return block;
}

inline PlaneBox shrunk(PlaneBox box, double left, double below, double right, double above) {
  return {box.low + Vec2{left, below}, box.high - Vec2{right, above}};
}

}  // namespace glissade::drawing
