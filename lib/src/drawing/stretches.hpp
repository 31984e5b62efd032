#pragma once

#include "glissade/parts/shop_part.hpp"

#include "drawing/views.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace glissade::drawing {

/// A workshop's pieces in stretches of what an eye sees, from left to right, in each of them no more kinds of parts than a drawing has
/// room to number.
/// @param most     kinds of parts in a stretch; >= 1
/// @param longest  from the first middle of a piece in a stretch to its last, to the right [mm]
/// @return one workshop a stretch: of each part the pieces whose middles lie in it, parts without any left out, numbers as they were;
///         as few stretches as there can be, the fullest of them as little full as it can be. Each piece lies in one
[[nodiscard]] std::vector<Workshop> stretches_of(const Workshop& workshop, const Eye& eye, std::size_t most,
                                                 double longest = std::numeric_limits<double>::infinity());

/// @return the middle of a piece as an eye sees it [mm]
[[nodiscard]] Vec2 middle_of(const ShopPart& part, const Frame& place, const Eye& eye);

}  // namespace glissade::drawing
