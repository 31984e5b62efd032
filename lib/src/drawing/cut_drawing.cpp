#include "glissade/core/error.hpp"
#include "glissade/drawing/workshop_drawings.hpp"

#include <optional>
#include <string>

namespace glissade {
namespace {

constexpr double kMillimetres = 1000.0;  // in a metre
/// Of the pattern's lower left corner: some viewers draw arcs wrongly that touch the edge of their page.
constexpr double kCorner = 10.0;

// AutoCAD colours.
constexpr int kBlack = 7;
constexpr int kGreen = 3;
constexpr int kRed = 1;
constexpr int kBlue = 5;
constexpr int kMagenta = 6;

/// Where lines of each purpose go; no name: they are left out.
struct CutLayers {
  const char* outline;
  const char* inside;
  const char* mark;
  const char* bend_up;
  const char* bend_down;
  const char* roll;
};

CutLayers layers_of(LayerPreset preset) {
  switch (preset) {
    case LayerPreset::plain:
      return {"0", "0", "0", "0", "0", "0"};
    case LayerPreset::inventor:
      return {"IV_OUTER_PROFILE", "IV_INTERIOR_PROFILES", "IV_FEATURE_PROFILES",
              "IV_BEND",          "IV_BEND_DOWN",         "IV_ROLL"};
    case LayerPreset::sendcutsend:
      return {"0", "0", nullptr, "0", "0", nullptr};
    case LayerPreset::own:
      break;
  }
  return {"CUT", "CUT", "MARK", "BEND_UP", "BEND_DOWN", "ROLL"};
}

class CutDrawing {
 public:
  CutDrawing(const ShopPart& part, LayerPreset preset) : part_(part), names_(layers_of(preset)) {}

  Drawing whole() {
    const FlatPattern& pattern = *part_.pattern;
    drawing_.name = part_.name;
    const PlaneBox box = bounds(pattern.region.outline);
    shift_ = Vec2{kCorner, kCorner} - kMillimetres * box.low;
    add(names_.outline, pattern.region.outline, LineStyle::continuous, kBlack);
    for (const ArcPath& cutout : pattern.region.cutouts)
      add(names_.inside, cutout, LineStyle::continuous, kBlack);
    for (const Circle& hole : pattern.region.holes) {
      drawing_.add(layer(names_.inside, LineStyle::continuous, kBlack),
                   Circle{place(hole.centre), kMillimetres * hole.radius});
    }
    for (const BendLine& bend : pattern.bends) {
      add(bend.up ? names_.bend_up : names_.bend_down, line(bend.from, bend.to), LineStyle::dashed,
          bend.up ? kGreen : kRed);
    }
    for (const RollLine& roll : pattern.rolls) {
      add(names_.roll, line(roll.from, roll.to), LineStyle::chain, kMagenta);
    }
    for (const ArcPath& mark : pattern.marks) add(names_.mark, mark, LineStyle::continuous, kBlue);
    number();
    return drawing_;
  }

 private:
  [[nodiscard]] Vec2 place(Vec2 metres) const { return kMillimetres * metres + shift_; }
  static ArcPath line(Vec2 from, Vec2 to) { return {{{from}, {to}}, false}; }

  std::size_t layer(const char* name, LineStyle style, int colour) {
    return drawing_.layer({name, style, 0.25, colour});
  }

  void add(const char* name, const ArcPath& path, LineStyle style, int colour) {
    if (name == nullptr) return;
    ArcPath placed = path;
    for (PathVertex& vertex : placed.vertices) vertex.at = place(vertex.at);
    const std::size_t on = layer(name, style, colour);
    drawing_.add(on, std::move(placed));
    // On a layer that others share, a line says itself what it is.
    const DrawingLayer& shared = drawing_.layers[on];
    if (shared.colour != colour) drawing_.paths.back().colour = colour;
    if (shared.style != style) drawing_.paths.back().style = style;
  }

  void number() {
    const FlatPattern& pattern = *part_.pattern;
    if (!pattern.number_at || names_.mark == nullptr) return;
    const std::string digits = (part_.number < 10 ? "0" : "") + std::to_string(part_.number);
    for (const ArcPath& stroke : stroked_text(digits, *pattern.number_at, pattern.number_height)) {
      add(names_.mark, stroke, LineStyle::continuous, kBlue);
    }
  }

  const ShopPart& part_;
  CutLayers names_;
  Drawing drawing_;
  Vec2 shift_;
};

}  // namespace

Drawing cut_drawing(const ShopPart& part, LayerPreset preset) {
  if (!part.pattern) {
    throw InputError({"part " + std::to_string(part.number) + ", " + part.name, "is cut from no sheet",
                      "It has no flat pattern.", ""});
  }
  return CutDrawing(part, preset).whole();
}

std::vector<Sheet> part_template(const Workshop& workshop, const ShopPart& part, TemplatePaper paper) {
  if (!part.pattern) return {};
  TitleBlock title;
  title.owner = workshop.name;
  title.number = std::to_string(part.number);
  title.title = part.name;
  if (paper == TemplatePaper::roll) return {roll_template(cut_drawing(part), title)};
  return tiled_template(cut_drawing(part), title, paper == TemplatePaper::a4 ? PaperSize::a4 : PaperSize::a3);
}

}  // namespace glissade
