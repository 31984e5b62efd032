#include "glissade/drawing/sheet.hpp"

#include "glissade/core/number_text.hpp"

#include "drawing/extents.hpp"
#include "drawing/ink.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace glissade {
namespace drawing {
namespace {

Vec2 on_paper(const SheetView& view, Vec2 point) {
  return view.at + view.scale * (point - view.anchor);
}

/// What no pen on paper tells apart [mm].
constexpr double kSpeck = 0.02;

/// A path as it is drawn at a reduced scale: chords that end within a speck of where the pen is are left out.
/// @return whether anything is left to see
bool thin_out(ArcPath& path) {
  double sum = 0.0;
  for (const PathVertex& vertex : path.vertices) sum += vertex.at.x + vertex.at.y + vertex.bulge;
  if (!std::isfinite(sum)) return true;  // refused where it is drawn
  const PlaneBox box = bounds(path);
  if (box.width() < kSpeck && box.height() < kSpeck) return false;
  std::vector<PathVertex> kept = {path.vertices.front()};
  for (std::size_t i = 1; i + 1 < path.vertices.size(); ++i) {
    const bool straight = path.vertices[i].bulge == 0.0 && path.vertices[i - 1].bulge == 0.0;
    if (straight && norm(path.vertices[i].at - kept.back().at) < kSpeck) continue;
    kept.push_back(path.vertices[i]);
  }
  if (path.vertices.size() > 1) kept.push_back(path.vertices.back());
  path.vertices = std::move(kept);
  return true;
}

/// Lines that a pen has drawn, to the speck and whichever way they run.
class DrawnLines {
 public:
  /// @return false of one that is there already
  bool add(const DrawnPath& drawn) {
    const std::vector<PathVertex>& vertices = drawn.path.vertices;
    if (vertices.size() != 2 || vertices.front().bulge != 0.0 || drawn.path.closed) return true;
    const auto specks = [](Vec2 at) {
      return std::array{std::llround(at.x / kSpeck), std::llround(at.y / kSpeck)};
    };
    const auto [low, high] = std::minmax({specks(vertices.front().at), specks(vertices.back().at)});
    const long long style = drawn.style ? 1 + static_cast<long long>(*drawn.style) : 0;
    return known_.insert({low[0], low[1], high[0], high[1], 4 * static_cast<long long>(drawn.layer) + style})
        .second;
  }

 private:
  using Key = std::array<long long, 5>;  // both ends, layer and style
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::size_t sum = 0;
      for (const long long value : key) sum = 0x9E3779B97F4A7C15U * (sum ^ static_cast<std::size_t>(value));
      return sum ^ (sum >> 32U);
    }
  };
  std::unordered_set<Key, Hash> known_;
};

void place(const SheetView& view, Drawing& ink) {
  Drawing flat = view.drawing;
  // Texts of dimensions keep their height on paper, so dimensions are taken apart at the view's scale.
  flat.text_scale = 1.0 / view.scale;
  flat = without_dimensions(flat);
  ink.layers = flat.layers;
  DrawnLines lines;
  for (DrawnPath& drawn : flat.paths) {
    for (PathVertex& vertex : drawn.path.vertices) vertex.at = on_paper(view, vertex.at);
    const bool reduced = view.scale < 1.0 && !drawn.filled && !drawn.path.vertices.empty();
    if (reduced && !(thin_out(drawn.path) && lines.add(drawn))) continue;
    ink.paths.push_back(std::move(drawn));
  }
  for (const DrawnCircle& drawn : flat.circles) {
    ink.circles.push_back(
        {drawn.layer, {on_paper(view, drawn.circle.centre), view.scale * drawn.circle.radius}});
  }
  for (DrawnText& text : flat.texts) {
    text.at = on_paper(view, text.at);
    ink.texts.push_back(std::move(text));
  }
}

void write_caption(const SheetView& view, Drawing& ink) {
  const auto box = bounds(view.drawing);
  if (view.caption.empty() || !box) return;
  const Vec2 low = on_paper(view, box->low);
  const Vec2 high = on_paper(view, box->high);
  constexpr double kBelow = 16.0;  // below the dimensions under a view
  DrawnText caption;
  caption.layer = ink.layer(text_ink());
  caption.at = {0.5 * (low.x + high.x), low.y - kBelow};
  caption.height_mm = 3.5;
  caption.text = view.caption;
  caption.anchor = TextAnchor::centre;
  ink.texts.push_back(std::move(caption));
}

}  // namespace

DrawingLayer thick_ink() {
  return {"FRAME", LineStyle::continuous, 0.5, 7};
}
DrawingLayer thin_ink() {
  return {"THIN", LineStyle::continuous, 0.25, 7};
}
DrawingLayer text_ink() {
  return {"TEXT", LineStyle::continuous, 0.25, 7};
}

void write_fitted(Drawing& ink, std::size_t layer, const std::string& text, Vec2 at, double height,
                  double room, TextAnchor anchor) {
  if (text.empty()) return;
  const double width = stroked_width(text, height);
  DrawnText drawn;
  drawn.layer = layer;
  drawn.at = at;
  drawn.height_mm = width > room ? height * room / width : height;
  drawn.text = text;
  drawn.anchor = anchor;
  ink.texts.push_back(std::move(drawn));
}

std::vector<Ink> ink_of(const Sheet& sheet) {
  std::vector<Ink> inks;
  for (const SheetView& view : sheet.views) {
    Ink ink{{}, view.clip};
    place(view, ink.drawing);
    write_caption(view, ink.drawing);
    inks.push_back(std::move(ink));
  }
  Ink over;
  if (sheet.frame) draw_frame(sheet, over.drawing);
  for (const SheetTable& table : sheet.tables) draw_table(table, over.drawing);
  const std::size_t layer = over.drawing.layer(text_ink());
  for (DrawnText text : sheet.texts) {
    text.layer = layer;
    over.drawing.texts.push_back(std::move(text));
  }
  inks.push_back(std::move(over));
  return inks;
}

}  // namespace drawing

Sheet blank_sheet(PaperSize size, bool landscape) {
  Sheet sheet;
  sheet.width_mm = size == PaperSize::a4 ? 297.0 : 420.0;
  sheet.height_mm = size == PaperSize::a4 ? 210.0 : 297.0;
  if (!landscape) std::swap(sheet.width_mm, sheet.height_mm);
  return sheet;
}

std::string scale_text(double scale) {
  return scale >= 1.0 ? rounded_text(scale, 6) + ":1" : "1:" + rounded_text(1.0 / scale, 6);
}

namespace drawing {
namespace {

/// ISO 5455 and its series beyond 50:1 and 1:10000.
/// @param step  1:1 at 0, 2:1 at 1, 5:1 at 2, 10:1 at 3; 1:2 at -1
double scale_at(int step) {
  constexpr std::array kFactors = {1.0, 2.0, 5.0};
  const int size = std::abs(step);
  double factor = kFactors[static_cast<std::size_t>(size % 3)];
  for (int decade = 0; decade < size / 3; ++decade) factor *= 10.0;
  return step < 0 ? 1.0 / factor : factor;
}

/// More than lies between an atom and the sun, taken for one sheet each.
constexpr int kMostSteps = 60;  // budget

/// @param fits  of a scale
/// @return the largest step of the series that fits, at most `from`; the smallest one where none does
int fitting_step(int from, auto&& fits) {
  int step = from;
  while (step > -kMostSteps && !fits(scale_at(step))) --step;
  return step;
}

bool holds(const PlaneBox& outer, const PlaneBox& inner) {
  return inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

/// @return the step of the scale at which a box fits a room; 1:1 of a box without a size
int step_of(const PlaneBox& box, const PlaneBox& room) {
  if (box.width() == 0.0 && box.height() == 0.0) return 0;
  return fitting_step(kMostSteps, [&](double scale) {
    return scale * box.width() <= room.width() && scale * box.height() <= room.height();
  });
}

}  // namespace
}  // namespace drawing

SheetView fitted_view(Drawing drawing, const PlaneBox& room, std::string caption) {
  SheetView view;
  const PlaneBox box = bounds(drawing).value_or(PlaneBox{});
  view.scale = drawing::scale_at(drawing::step_of(box, room));
  view.anchor = 0.5 * (box.low + box.high);
  view.at = 0.5 * (room.low + room.high);
  view.drawing = std::move(drawing);
  view.caption = std::move(caption);
  return view;
}

SheetView fitted_view_with_texts(Drawing drawing, const PlaneBox& room, const PlaneBox& outer) {
  SheetView view = fitted_view(std::move(drawing), room);
  const int largest = drawing::step_of(bounds(view.drawing).value_or(PlaneBox{}), room);
  const int step = drawing::fitting_step(largest, [&](double scale) {
    view.scale = scale;
    Drawing ink;
    drawing::place(view, ink);
    const auto box = drawing::extents(ink);
    return !box || drawing::holds(outer, *box);
  });
  view.scale = drawing::scale_at(step);
  return view;
}

std::vector<Sheet> numbered(std::vector<Sheet> sheets) {
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    sheets[i].title.sheet = std::to_string(i + 1) + "/" + std::to_string(sheets.size());
  }
  return sheets;
}

}  // namespace glissade
