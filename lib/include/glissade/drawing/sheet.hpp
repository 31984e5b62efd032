#pragma once

#include "glissade/drawing/drawing.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// A sheet of paper with drawings at a scale, tables, frame and title block; millimetres of paper from its lower left
/// corner, x to the right and y up.

enum class PaperSize { a4, a3 };

/// What the title block says (ISO 7200); empty fields stay empty.
struct TitleBlock {
  std::string title;        ///< of the sheet: "Side plate, left"
  std::string owner;        ///< the design's name
  std::string number;       ///< of the drawing or part
  std::string material;     ///< with thickness
  std::string scale;        ///< "1:20"; empty: of the first view
  std::string note;         ///< one line, e.g. general tolerance
  std::string sheet;        ///< "2/14"; numbered() fills it in
  std::string unit = "mm";  ///< that dimensions are in
};

/// A drawing on paper.
struct SheetView {
  Drawing drawing;
  double scale = 1.0;                 ///< paper over real size: 0.05 for 1:20
  Vec2 at;                            ///< where the drawing's `anchor` lies on paper [mm]
  Vec2 anchor;                        ///< in the drawing's millimetres
  std::string caption;                ///< below the view; may be empty
  std::optional<PlaneBox> clip = {};  ///< nothing is drawn outside [mm of paper]
};

/// Rows of text in columns.
struct SheetTable {
  Vec2 at;  ///< of its upper left corner [mm]
  std::string caption;
  std::vector<double> widths_mm;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  double text_height_mm = 2.5;
};

/// A sheet of paper with its views, tables and title block.
struct Sheet {
  double width_mm = 297.0;
  double height_mm = 210.0;
  bool frame = true;  ///< with the title block
  TitleBlock title;
  std::vector<SheetView> views;
  std::vector<SheetTable> tables;
  std::vector<DrawnText> texts;  ///< in millimetres of paper
};

/// @return a sheet of that size, lying where `landscape`
[[nodiscard]] Sheet blank_sheet(PaperSize size, bool landscape = true);

/// @return the room that frame and title block leave for views [mm]
[[nodiscard]] PlaneBox drawing_area(const Sheet& sheet);

/// Puts a drawing into a rectangle of the paper, in its middle, at the largest scale of ISO 5455 at which its paths and circles fit
/// (1:1, 1:2, 1:5, 1:10, 1:20, ... and enlargements 2:1, 5:1, 10:1, ...; the series goes on to 1e20 both ways). 1:1 of one without
/// a size.
[[nodiscard]] SheetView fitted_view(Drawing drawing, const PlaneBox& room, std::string caption = "");

/// The same, or as much smaller as it takes for its texts and dimensions, whose size on paper stays, to lie within `outer`.
[[nodiscard]] SheetView fitted_view_with_texts(Drawing drawing, const PlaneBox& room, const PlaneBox& outer);

/// @return "1:20", "2:1"
[[nodiscard]] std::string scale_text(double scale);

/// @return the same sheets, each told which of how many it is
[[nodiscard]] std::vector<Sheet> numbered(std::vector<Sheet> sheets);

/// A table that does not fit one sheet, over as many as it takes.
[[nodiscard]] std::vector<Sheet> table_sheets(const TitleBlock& title, PaperSize size, SheetTable table);

/// 1:1 templates: a drawing over as many sheets as it takes, lying or upright, whichever are fewer, to be glued together at crosses;
/// sheets that would show nothing of it, neither a line nor the inside of a contour, are left out. Every sheet says which of how many
/// it is, its row and column, shows its place among the others small, and carries bars of 100 mm in both directions.
/// @param overlap_mm  of neighbouring sheets
[[nodiscard]] std::vector<Sheet> tiled_template(const Drawing& drawing, const TitleBlock& title,
                                                PaperSize size, double overlap_mm = 10.0);

/// 1:1 template on a roll: one sheet as long as it takes; sheets of 5 m where it takes more, which no PDF page may have.
[[nodiscard]] std::vector<Sheet> roll_template(const Drawing& drawing, const TitleBlock& title,
                                               double overlap_mm = 10.0);

/// @param size  of the paper; none: a roll
/// @return how many sheets the two above have
[[nodiscard]] std::size_t template_sheets(const Drawing& drawing, std::optional<PaperSize> size,
                                          double overlap_mm = 10.0);

}  // namespace glissade
