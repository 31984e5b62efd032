#pragma once

#include "glissade/drawing/drawing.hpp"

#include <optional>

namespace glissade::drawing {

/// @param scale  paper over real size
/// @return the least rectangle that surely holds a text, whatever the lettering, in real millimetres
[[nodiscard]] PlaneBox extents(const DrawnText& text, double scale);

/// @return the least rectangle that holds every path and circle and, as they stand at 1 : Drawing::text_scale, texts and
///         dimensions; none where there is nothing
[[nodiscard]] std::optional<PlaneBox> extents(const Drawing& drawing);

}  // namespace glissade::drawing
