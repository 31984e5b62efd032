#pragma once

#include "glissade/drawing/sheet.hpp"

#include <optional>
#include <vector>

namespace glissade::drawing {

/// Lines and texts in millimetres of paper, with nothing left to scale.
struct Ink {
  Drawing drawing;
  std::optional<PlaneBox> clip;
};

/// @return everything on a sheet: frame, title block, views with their dimensions, tables
[[nodiscard]] std::vector<Ink> ink_of(const Sheet& sheet);

/// Ink of frame and title block.
void draw_frame(const Sheet& sheet, Drawing& ink);
/// @return the room to the left of the title block [mm]
[[nodiscard]] PlaneBox notes_area(const Sheet& sheet);
/// Ink of a table.
void draw_table(const SheetTable& table, Drawing& ink);
/// @return how high a table gets with so many rows [mm]
[[nodiscard]] double table_height(const SheetTable& table, std::size_t rows);

/// A text that is made smaller where it would be wider than its room.
void write_fitted(Drawing& ink, std::size_t layer, const std::string& text, Vec2 at, double height,
                  double room, TextAnchor anchor = TextAnchor::left);

/// Layers of ink.
[[nodiscard]] DrawingLayer thick_ink();  ///< 0.5 mm: frame
[[nodiscard]] DrawingLayer thin_ink();   ///< 0.25 mm
[[nodiscard]] DrawingLayer text_ink();

}  // namespace glissade::drawing
