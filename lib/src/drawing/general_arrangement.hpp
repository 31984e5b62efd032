#pragma once

#include "glissade/drawing/sheet.hpp"
#include "glissade/parts/shop_part.hpp"

#include <vector>

namespace glissade::drawing {

/// The whole from the side and from above (first angle), its parts numbered, joints and supports named, main dimensions;
/// notes beside the title block. Of more kinds of parts than can be told apart the whole has a number a family, and stretches of it, one
/// a sheet, have them all, with how many pieces of each lie there. Notes that find no room there are on a sheet of their own.
[[nodiscard]] std::vector<Sheet> general_arrangement(const Workshop& workshop);

}  // namespace glissade::drawing
