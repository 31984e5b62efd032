#include "drawing/cut_pen.hpp"

#include "core/millimetres.hpp"

#include <string>
#include <utility>

namespace glissade::drawing {
namespace {

constexpr double kWidth = 0.25;  // of lines, on paper [mm]

ArcPath line(Vec2 from, Vec2 to) {
  return {{{from}, {to}}, false};
}

}  // namespace

CutLayers layers_of(LayerPreset preset) {
  switch (preset) {
    case LayerPreset::plain:
      return {"0", "0", "0", "0", "0", "0", "0", "0"};
    case LayerPreset::inventor:
      return {"IV_OUTER_PROFILE",
              "IV_INTERIOR_PROFILES",
              "IV_FEATURE_PROFILES",
              "IV_BEND",
              "IV_BEND_DOWN",
              "IV_ROLL",
              "LABEL",
              "SHEET"};
    case LayerPreset::sendcutsend:
      return {"0", "0", nullptr, "0", "0", nullptr, nullptr, nullptr};
    case LayerPreset::own:
      break;
  }
  return {"CUT", "CUT", "MARK", "BEND_UP", "BEND_DOWN", "ROLL", "LABEL", "SHEET"};
}

void CutPen::add(const char* name, ArcPath path, LineStyle style, int colour) {
  if (name == nullptr) return;
  const std::size_t on = drawing_.layer({name, style, kWidth, colour});
  drawing_.add(on, std::move(path));
  // On a layer that others share, a line says itself what it is.
  const DrawingLayer& shared = drawing_.layers[on];
  if (shared.colour != colour) drawing_.paths.back().colour = colour;
  if (shared.style != style) drawing_.paths.back().style = style;
}

void CutPen::pattern(const ShopPart& part, const PlaneMotion& motion, Vec2 shift) {
  const FlatPattern& pattern = *part.pattern;
  const auto placed = [&](ArcPath path) {
    path = moved(path, motion);
    for (PathVertex& vertex : path.vertices) vertex.at = core::kMillimetres * vertex.at + shift;
    return path;
  };
  add(names_.outline, placed(pattern.region.outline), LineStyle::continuous, kBlack);
  for (const ArcPath& cutout : pattern.region.cutouts)
    add(names_.inside, placed(cutout), LineStyle::continuous, kBlack);
  for (const Circle& hole : pattern.region.holes) {
    drawing_.add(drawing_.layer({names_.inside, LineStyle::continuous, kWidth, kBlack}),
                 Circle{core::kMillimetres * motion(hole.centre) + shift, core::kMillimetres * hole.radius});
  }
  for (const BendLine& bend : pattern.bends) {
    add(bend.up ? names_.bend_up : names_.bend_down, placed(line(bend.from, bend.to)), LineStyle::dashed,
        bend.up ? kGreen : kRed);
  }
  for (const RollLine& roll : pattern.rolls)
    add(names_.roll, placed(line(roll.from, roll.to)), LineStyle::chain, kMagenta);
  for (const ArcPath& mark : pattern.marks) add(names_.mark, placed(mark), LineStyle::continuous, kBlue);
  if (!pattern.number_at) return;
  const std::string digits = (part.number < 10 ? "0" : "") + std::to_string(part.number);
  for (const ArcPath& stroke : stroked_text(digits, *pattern.number_at, pattern.number_height))
    add(names_.mark, placed(stroke), LineStyle::continuous, kBlue);
}

}  // namespace glissade::drawing
