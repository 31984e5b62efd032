#pragma once

#include "glissade/parts/shop_part.hpp"

#include "report/serial/vocabulary.hpp"

namespace glissade::report {

/// A part's flat pattern as the page draws it, in metres rounded to a tenth of a micrometre; null where nobody cuts it from
/// a sheet. Paths are lists of [x, y, bulge], closed ones as glissade/core/arc_path.hpp has them.
[[nodiscard]] Json pattern_json(const ShopPart& part);

}  // namespace glissade::report
