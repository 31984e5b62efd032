#include "glissade/core/error.hpp"
#include "glissade/drawing/workshop_drawings.hpp"

#include "core/least_rectangle.hpp"
#include "core/millimetres.hpp"
#include "drawing/cut_pen.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade {
namespace {

/// Of the pattern's lower left corner: some viewers draw arcs wrongly that touch the edge of their page.
constexpr double kCorner = 10.0;

}  // namespace

Drawing cut_drawing(const ShopPart& part, LayerPreset preset) {
  if (!part.pattern) {
    throw InputError({"part " + std::to_string(part.number) + ", " + part.name, "is cut from no sheet",
                      "It has no flat pattern.", ""});
  }
  Drawing drawing;
  drawing.name = part.name;
  const PlaneBox box = bounds(part.pattern->region.outline);
  drawing::CutPen(drawing, preset).pattern(part, {}, Vec2{kCorner, kCorner} - core::kMillimetres * box.low);
  return drawing;
}

namespace {

/// What is cut, its least rectangle along the axes.
Drawing lying_drawing(const ShopPart& part) {
  constexpr double kSagitta = 1e-4;  // [m]
  const double angle = core::lying_angle(flattened(part.pattern->region.outline, kSagitta));
  const PlaneMotion motion = PlaneMotion::turn(angle);
  Drawing drawing;
  drawing.name = part.name;
  drawing::CutPen(drawing, LayerPreset::own).pattern(part, motion, {0.0, 0.0});
  return drawing;
}

}  // namespace

std::vector<Sheet> part_template(const Workshop& workshop, const ShopPart& part, TemplatePaper paper) {
  if (!part.pattern) return {};
  TitleBlock title;
  title.owner = workshop.name;
  title.number = std::to_string(part.number);
  title.title = part.name;
  const Drawing drawing = lying_drawing(part);
  if (paper == TemplatePaper::roll) return roll_template(drawing, title);
  return tiled_template(drawing, title, paper == TemplatePaper::a4 ? PaperSize::a4 : PaperSize::a3);
}

TemplatePages template_pages(const ShopPart& part) {
  if (!part.pattern) return {};
  const Drawing drawing = lying_drawing(part);
  return {template_sheets(drawing, PaperSize::a4), template_sheets(drawing, PaperSize::a3),
          template_sheets(drawing, std::nullopt)};
}

}  // namespace glissade
