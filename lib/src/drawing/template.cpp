#include "drawing/ink.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace glissade {
namespace {

// What office printers leave white [mm].
constexpr double kUnprinted = 8.0;
constexpr double kBar = 100.0;
constexpr double kFoot = 14.0;  // room for the words below the picture

/// Bars of 100 mm in both directions, to be held against a rule before anything is cut.
void scale_bars(Drawing& drawing, Vec2 corner) {
  const std::size_t thin = drawing.layer(drawing::thin_ink());
  for (const bool level : {true, false}) {
    const Vec2 along = level ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0};
    const Vec2 aside = level ? Vec2{0.0, 1.0} : Vec2{1.0, 0.0};
    drawing.line(thin, corner, corner + kBar * along);
    for (int tick = 0; tick <= 10; ++tick) {
      const double size = tick % 5 == 0 ? 3.0 : 1.5;
      const Vec2 foot = corner + (0.1 * kBar * tick) * along;
      drawing.line(thin, foot, foot + size * aside);
    }
  }
  DrawnText text;
  text.layer = drawing.layer(drawing::text_ink());
  text.at = corner + Vec2{6.0, 4.5};
  text.text = "100 mm both ways: print at 100 %, no fit to page";
  drawing.texts.push_back(std::move(text));
}

/// Crosses where neighbouring sheets are laid over each other.
void register_marks(Drawing& drawing, const PlaneBox& tile, double overlap) {
  const std::size_t thin = drawing.layer(drawing::thin_ink());
  constexpr double kArm = 4.0;
  for (const double x : {tile.low.x + 0.5 * overlap, tile.high.x - 0.5 * overlap}) {
    for (const double y : {tile.low.y + 0.5 * overlap, tile.high.y - 0.5 * overlap}) {
      drawing.line(thin, {x - kArm, y}, {x + kArm, y});
      drawing.line(thin, {x, y - kArm}, {x, y + kArm});
    }
  }
}

Sheet bare_sheet(double width, double height) {
  Sheet sheet;
  sheet.width_mm = width;
  sheet.height_mm = height;
  sheet.frame = false;
  return sheet;
}

SheetView life_size(Drawing drawing, Vec2 at, Vec2 anchor) {
  SheetView view;
  view.drawing = std::move(drawing);
  view.at = at;
  view.anchor = anchor;
  return view;
}

/// Bars and words of a sheet, in millimetres of paper.
SheetView foot_of(const std::string& words, Vec2 corner, double width) {
  Drawing foot;
  scale_bars(foot, corner);
  drawing::write_fitted(foot, foot.layer(drawing::text_ink()), words, corner + Vec2{0.0, -4.5}, 2.5, width);
  return life_size(std::move(foot), {}, {});
}

}  // namespace

std::vector<Sheet> tiled_template(const Drawing& drawing, const TitleBlock& title, PaperSize size,
                                  double overlap_mm) {
  std::vector<Sheet> sheets;
  const auto box = bounds(drawing);
  if (!box) return sheets;
  const Sheet blank = blank_sheet(size);
  const PlaneBox window{{kUnprinted, kUnprinted + kFoot},
                        {blank.width_mm - kUnprinted, blank.height_mm - kUnprinted}};
  const auto count = [&](double length, double room) {
    return length <= room ? 1 : static_cast<int>(std::ceil((length - overlap_mm) / (room - overlap_mm)));
  };
  const int columns = count(box->width(), window.width());
  const int rows = count(box->height(), window.height());
  // All sheets together reach beyond the drawing alike on both sides.
  const double step_x = window.width() - overlap_mm;
  const double step_y = window.height() - overlap_mm;
  const Vec2 start =
      0.5 * (box->low + box->high) - 0.5 * Vec2{columns * step_x + overlap_mm, rows * step_y + overlap_mm};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec2 low = start + Vec2{column * step_x, (rows - 1 - row) * step_y};
      Drawing tile = drawing;
      register_marks(tile, {low, low + Vec2{window.width(), window.height()}}, overlap_mm);
      Sheet sheet = bare_sheet(blank.width_mm, blank.height_mm);
      sheet.views.push_back(life_size(std::move(tile), window.low, low));
      sheet.views.back().clip = window;
      const std::string words = title.owner + "; " + title.number + " " + title.title + "; row " +
                                std::to_string(row + 1) + " of " + std::to_string(rows) + ", column " +
                                std::to_string(column + 1) + " of " + std::to_string(columns) + "; overlap " +
                                std::to_string(std::lround(overlap_mm)) + " mm";
      sheet.views.push_back(foot_of(words, {kUnprinted, kUnprinted + 6.0}, window.width()));
      sheets.push_back(std::move(sheet));
    }
  }
  return sheets;
}

Sheet roll_template(const Drawing& drawing, const TitleBlock& title) {
  constexpr double kEdge = 20.0;
  constexpr double kRoom = 30.0;  // for bars and words
  const PlaneBox box = bounds(drawing).value_or(PlaneBox{});
  const double width = std::fmax(box.width(), kBar + 20.0) + 2.0 * kEdge;
  Sheet sheet = bare_sheet(width, std::fmax(box.height(), kBar) + 2.0 * kEdge + kRoom);
  sheet.views.push_back(life_size(drawing, {kEdge, kEdge + kRoom}, box.low));
  sheet.views.push_back(
      foot_of(title.owner + "; " + title.number + " " + title.title, {kEdge, kEdge}, width - 2.0 * kEdge));
  return sheet;
}

}  // namespace glissade
