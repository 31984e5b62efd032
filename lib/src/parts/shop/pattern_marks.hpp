#pragma once

#include "glissade/parts/shop_part.hpp"

namespace glissade::parts {

/// What is drawn on a flat pattern beside its cuts: on the plate, once that is finished.

/// Says where a part's number may stand: level, as high as it fits, at most 20 mm, its box wholly on the plate, clear of
/// edges, cutouts, holes and bends by a tenth of its height; beside the outline's middle where there is room. Across bends where it
/// fits nowhere else; none where it does not fit at all, 10 mm high, and on plates narrower than 40 mm.
/// @param number  of the part; >= 1
void set_number_place(FlatPattern& pattern, int number);

/// Ends the lines of bends and rolls at the outline: of each what is left is its longest stretch on the plate. Lines that
/// are nowhere on it stay.
void clip_lines(FlatPattern& pattern);

}  // namespace glissade::parts
