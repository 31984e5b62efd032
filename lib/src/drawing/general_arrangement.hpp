#pragma once

#include "glissade/drawing/sheet.hpp"
#include "glissade/parts/shop_part.hpp"

#include <vector>

namespace glissade::drawing {

/// The whole from the side and from above (first angle), its parts numbered, joints and supports named, main dimensions;
/// notes beside the title block. Notes that find no room there are on a sheet of their own.
[[nodiscard]] std::vector<Sheet> general_arrangement(const Workshop& workshop);

}  // namespace glissade::drawing
