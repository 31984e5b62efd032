#include "drawing/ink.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace glissade {
namespace drawing {
namespace {

constexpr double kRowPerText = 1.9;   // height of a row over that of its text
constexpr double kCaptionRoom = 6.0;  // [mm]

double row_height(const SheetTable& table) {
  return kRowPerText * table.text_height_mm;
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.-+") == std::string::npos;
}

void write_row(const SheetTable& table, const std::vector<std::string>& cells, double base, Drawing& ink) {
  const std::size_t text = ink.layer(text_ink());
  double left = table.at.x;
  for (std::size_t i = 0; i < cells.size() && i < table.widths_mm.size(); ++i) {
    const double width = table.widths_mm[i];
    const bool right = is_number(cells[i]);
    const double x = right ? left + width - 1.2 : left + 1.2;
    write_fitted(ink, text, cells[i], {x, base}, table.text_height_mm, width - 2.4,
                 right ? TextAnchor::right : TextAnchor::left);
    left += width;
  }
}

}  // namespace

double table_height(const SheetTable& table, std::size_t rows) {
  return (table.caption.empty() ? 0.0 : kCaptionRoom) + (static_cast<double>(rows) + 1.0) * row_height(table);
}

void draw_table(const SheetTable& table, Drawing& ink) {
  const std::size_t thick = ink.layer(thick_ink());
  const std::size_t thin = ink.layer(thin_ink());
  const double width = std::accumulate(table.widths_mm.begin(), table.widths_mm.end(), 0.0);
  double top = table.at.y;
  if (!table.caption.empty()) {
    top -= kCaptionRoom;
    write_fitted(ink, ink.layer(text_ink()), table.caption, {table.at.x, top + 2.0}, 3.0, width);
  }
  const double step = row_height(table);
  const double bottom = top - step * (static_cast<double>(table.rows.size()) + 1.0);
  const double drop = 0.5 * (step + table.text_height_mm);
  write_row(table, table.header, top - drop, ink);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double y = top - step * (static_cast<double>(i) + 1.0);
    ink.line(i == 0 ? thick : thin, {table.at.x, y}, {table.at.x + width, y});
    write_row(table, table.rows[i], y - drop, ink);
  }
  double x = table.at.x;
  for (std::size_t i = 0; i + 1 < table.widths_mm.size(); ++i) {
    x += table.widths_mm[i];
    ink.line(thin, {x, top}, {x, bottom});
  }
  ink.add(thick, rectangle({table.at.x, bottom}, {table.at.x + width, top}));
}

}  // namespace drawing

std::vector<Sheet> table_sheets(const TitleBlock& title, PaperSize size, SheetTable table) {
  std::vector<Sheet> sheets;
  const std::vector<std::vector<std::string>> rows = std::move(table.rows);
  std::size_t next = 0;
  do {
    Sheet sheet = blank_sheet(size, size == PaperSize::a3);
    sheet.title = title;
    sheet.title.scale = "-";
    const PlaneBox room = drawing_area(sheet);
    SheetTable part = table;
    part.at = {room.low.x, room.high.y};
    part.rows.clear();
    while (next < rows.size() && drawing::table_height(part, part.rows.size() + 1) <= room.height()) {
      part.rows.push_back(rows[next++]);
    }
    // No row stands alone on the last sheet, a total least of all.
    if (next + 1 == rows.size() && part.rows.size() > 2) {
      part.rows.pop_back();
      --next;
    }
    sheet.tables.push_back(std::move(part));
    sheets.push_back(std::move(sheet));
  } while (next < rows.size());
  return sheets;
}

}  // namespace glissade
