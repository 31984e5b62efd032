#pragma once

#include "glissade/core/workshop_format.hpp"
#include "glissade/drawing/sheet.hpp"
#include "glissade/parts/workshop_build.hpp"

#include <vector>

namespace glissade {

/// Drawings of what a workshop makes: cutting patterns, views, the set of sheets.

/// What is cut from a sheet, 1:1 in millimetres, its lower left corner at (10, 10): closed contour, cutouts, holes; bends
/// dashed, colours by their direction; roll lines; marks and the part's number in single strokes.
/// @throws InputError if the part has no pattern
[[nodiscard]] Drawing cut_drawing(const ShopPart& part, LayerPreset preset = LayerPreset::own);

/// A stock sheet with its pieces, 1:1 in millimetres, the sheet's lower left corner at the origin: each piece as cut_drawing() has it;
/// its number and name where they fit, for reading, on LABEL; the sheet's edge, what it is and a bar of 100 mm on SHEET. `plain` has
/// these on layer 0 too, grey; `sendcutsend` has none of them.
[[nodiscard]] Drawing nest_drawing(const Workshop& workshop, const NestedSheet& sheet,
                                   LayerPreset preset = LayerPreset::own);

/// All edges of all parts as seen from the side (the track from left to right) and from above; hidden edges are drawn too,
/// edges that fall together once.
[[nodiscard]] Drawing side_view(const Workshop& workshop);
[[nodiscard]] Drawing plan_view(const Workshop& workshop);

/// The sheets of an assembly: general arrangement (A3), parts list, bought-in items, a sheet a part (A4: flat pattern or
/// views with dimensions, holes, bends), bend schedule, setting-out table, checks; numbered.
[[nodiscard]] std::vector<Sheet> drawing_set(const Workshop& workshop);

/// 1:1 templates of a part's pattern, its least rectangle lying, tiled over sheets or on a roll; none for a part without one.
[[nodiscard]] std::vector<Sheet> part_template(const Workshop& workshop, const ShopPart& part,
                                               TemplatePaper paper);
/// @return how many sheets that is on each paper
[[nodiscard]] TemplatePages template_pages(const ShopPart& part);

}  // namespace glissade
