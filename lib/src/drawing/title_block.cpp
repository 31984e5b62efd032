#include "glissade/core/version.hpp"

#include "drawing/ink.hpp"

#include <algorithm>
#include <string>

namespace glissade {
namespace drawing {
namespace {

// ISO 5457: 20 mm on the side where sheets are bound, 10 mm elsewhere.
constexpr double kBinding = 20.0;
constexpr double kMargin = 10.0;
// ISO 7200: 180 mm wide, so that it fits A4 upright.
constexpr double kBlockWidth = 180.0;
constexpr double kRowHeight = 9.0;
constexpr int kRows = 4;
constexpr double kSplit = 120.0;  // of the columns

PlaneBox frame_of(const Sheet& sheet) {
  return {{kBinding, kMargin}, {sheet.width_mm - kMargin, sheet.height_mm - kMargin}};
}

PlaneBox block_of(const Sheet& sheet) {
  const PlaneBox frame = frame_of(sheet);
  const double width = std::min(kBlockWidth, frame.width());
  return {{frame.high.x - width, frame.low.y}, {frame.high.x, frame.low.y + kRows * kRowHeight}};
}

/// A field of the block: its name small, its content below.
void field(Drawing& ink, const std::string& name, const std::string& content, Vec2 low, double width,
           double height = 3.0) {
  const std::size_t text = ink.layer(text_ink());
  write_fitted(ink, text, name, low + Vec2{1.5, kRowHeight - 2.4}, 1.5, width - 3.0);
  write_fitted(ink, text, content, low + Vec2{1.5, 1.5}, height, width - 3.0);
}

/// First-angle projection (ISO 5456): a cone from the side, and its two circles to the right.
void projection_symbol(Drawing& ink, Vec2 centre) {
  const std::size_t thin = ink.layer(thin_ink());
  const auto at = [&](double x, double y) { return PathVertex{centre + Vec2{x, y}, 0.0}; };
  ink.add(thin, ArcPath{{at(-7.0, -1.25), at(-1.0, -2.5), at(-1.0, 2.5), at(-7.0, 1.25)}, true});
  ink.add(thin, Circle{centre + Vec2{4.5, 0.0}, 2.5});
  ink.add(thin, Circle{centre + Vec2{4.5, 0.0}, 1.25});
}

}  // namespace

PlaneBox notes_area(const Sheet& sheet) {
  constexpr double kClear = 5.0;
  const PlaneBox frame = frame_of(sheet);
  const PlaneBox block = block_of(sheet);
  return {{frame.low.x + kClear, frame.low.y + 0.5 * kClear}, {block.low.x - kClear, block.high.y}};
}

void draw_frame(const Sheet& sheet, Drawing& ink) {
  const std::size_t thick = ink.layer(thick_ink());
  const std::size_t thin = ink.layer(thin_ink());
  const PlaneBox frame = frame_of(sheet);
  const PlaneBox block = block_of(sheet);
  ink.add(thick, rectangle(frame.low, frame.high));
  ink.add(thick, rectangle(block.low, block.high));
  const double split = block.low.x + kSplit;
  for (int row = 1; row < kRows; ++row) {
    const double y = block.low.y + row * kRowHeight;
    ink.line(thin, {block.low.x, y}, {block.high.x, y});
  }
  ink.line(thin, {split, block.low.y}, {split, block.high.y});
  const TitleBlock& title = sheet.title;
  const std::string scale =
      !title.scale.empty() || sheet.views.empty() ? title.scale : scale_text(sheet.views.front().scale);
  const auto row = [&](int from_top) { return block.low.y + (kRows - 1 - from_top) * kRowHeight; };
  const double right = block.high.x - split;
  field(ink, "TITLE", title.title, {block.low.x, row(0)}, kSplit, 3.5);
  field(ink, "DESIGN", title.owner, {block.low.x, row(1)}, kSplit);
  field(ink, "MATERIAL", title.material, {block.low.x, row(2)}, kSplit);
  field(ink, "NOTE", title.note, {block.low.x, row(3)}, kSplit, 2.5);
  field(ink, "SHEET", title.sheet, {split, row(0)}, right);
  field(ink, "NUMBER", title.number, {split, row(1)}, right);
  field(ink, "SCALE", scale, {split, row(2)}, right);
  field(ink, "DIMENSIONS IN " + title.unit, "Glissade " + std::string(version()), {split, row(3)},
        right - 20.0, 2.5);
  projection_symbol(ink, {block.high.x - 10.0, row(3) + 0.5 * kRowHeight});
}

}  // namespace drawing

PlaneBox drawing_area(const Sheet& sheet) {
  if (!sheet.frame) return {{0.0, 0.0}, {sheet.width_mm, sheet.height_mm}};
  constexpr double kClear = 5.0;
  const PlaneBox frame = drawing::frame_of(sheet);
  const PlaneBox block = drawing::block_of(sheet);
  return {{frame.low.x + kClear, block.high.y + kClear}, frame.high - Vec2{kClear, kClear}};
}

}  // namespace glissade
