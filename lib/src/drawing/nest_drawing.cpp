// A stock sheet with the pieces that are cut from it.

#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"
#include "glissade/drawing/workshop_drawings.hpp"

#include "core/millimetres.hpp"
#include "drawing/cut_pen.hpp"

#include <algorithm>
#include <optional>
#include <string>

namespace glissade {
namespace {

using drawing::CutPen;
using drawing::kGrey;

constexpr double kBar = 100.0;          // [mm]
constexpr double kTitle = 10.0;         // height of the sheet's title and its distance from the edge [mm]
constexpr double kLargestLabel = 20.0;  // [mm]
constexpr double kLeastLabel = 3.0;     // [mm]

/// A line of text in single strokes, its middle at a place.
struct Label {
  std::string text;
  Vec2 middle;
  double height = 0.0;  ///< [mm]
  Angle angle;
};

/// Whether a label lies inside a region, clear of its holes; looked at along its box.
bool lies_inside(const PlaneRegion& region, const Label& label) {
  constexpr int kSteps = 12;
  const Vec2 along = PlaneMotion::turn(label.angle.radians())(Vec2{1.0, 0.0});
  const Vec2 up{-along.y, along.x};
  const double half = 0.5 * stroked_width(label.text, label.height);
  for (int i = 0; i <= kSteps; ++i) {
    // Descenders and underscores reach down to 0.8 heights.
    for (const double side : {-0.85, 0.0, 0.7}) {
      const double out = half * (2.0 * i / kSteps - 1.0);
      const Vec2 point = label.middle + out * along + side * label.height * up;
      const auto holds = [&](const ArcPath& cutout) { return contains(cutout, point); };
      const auto near = [&](const Circle& hole) {
        return norm(point - hole.centre) < hole.radius + 0.3 * label.height;
      };
      if (!contains(region.outline, point)) return false;
      if (std::any_of(region.cutouts.begin(), region.cutouts.end(), holds)) return false;
      if (std::any_of(region.holes.begin(), region.holes.end(), near)) return false;
    }
  }
  return true;
}

/// Places inside a region along an upright through its middle and two beside it, the middle of each stretch.
std::vector<Vec2> places_in(const PlaneRegion& region) {
  constexpr int kSteps = 64;
  std::vector<Vec2> places = {moments(region).centroid};
  const PlaneBox box = bounds(region.outline);
  for (const double share : {0.5, 0.3, 0.7, 0.15, 0.85}) {
    const double x = box.low.x + share * box.width();
    int first = -1;
    for (int i = 0; i <= kSteps; ++i) {
      const bool inside = i < kSteps && contains(region.outline, {x, box.low.y + box.height() * i / kSteps});
      if (inside && first < 0) first = i;
      if (inside || first < 0) continue;
      places.push_back({x, box.low.y + box.height() * (first + i - 1) / (2.0 * kSteps)});
      first = -1;
    }
  }
  return places;
}

/// A pattern on its sheet as a label has to keep clear of it: the number that is engraved counts as a hole.
PlaneRegion room_for_label(const ShopPart& part, const PlaneMotion& motion) {
  const FlatPattern& pattern = *part.pattern;
  PlaneRegion region = pattern.region;
  if (pattern.number_at) {
    const double size = pattern.number_height;
    const std::size_t digits = std::max<std::size_t>(2, std::to_string(part.number).size());
    // Two digits are about as wide as high; each further one takes as much again as a digit.
    for (std::size_t k = 0; k + 1 < digits; ++k) {
      region.holes.push_back(
          {*pattern.number_at + Vec2{(0.6 + 0.72 * static_cast<double>(k)) * size, 0.5 * size}, 0.9 * size});
    }
  }
  return scaled(moved(region, motion), core::kMillimetres);
}

/// Number and name as large as they fit into a region, level or upright; the number alone where both do not fit.
std::optional<Label> label_of(const ShopPart& part, const PlaneRegion& region) {
  const std::string number = (part.number < 10 ? "0" : "") + std::to_string(part.number);
  const std::vector<Vec2> places = places_in(region);
  for (const std::string& text : {number + " " + part.name, number}) {
    for (double height = kLargestLabel; height >= kLeastLabel; height *= 0.7) {
      for (const Vec2 place : places) {
        for (const double angle : {0.0, 90.0}) {
          Label label{text, place, height, Angle::from_degrees(angle)};
          if (lies_inside(region, label)) return label;
        }
      }
    }
  }
  return {};
}

void add_text(CutPen& pen, const char* layer, const Label& label) {
  const Vec2 down = PlaneMotion::turn(label.angle.radians())(Vec2{0.0, -0.5 * label.height});
  for (const ArcPath& stroke :
       stroked_text(label.text, label.middle + down, label.height, label.angle, TextAnchor::centre))
    pen.add(layer, stroke, LineStyle::continuous, kGrey);
}

/// The sheet's edge; above it, where nothing is cut, a bar and what the sheet is.
void add_sheet(CutPen& pen, const NestedSheet& sheet) {
  const char* const layer = pen.names().sheet;
  const double width = core::kMillimetres * sheet.stock.width;
  const double height = core::kMillimetres * sheet.stock.height;
  pen.add(layer, rectangle({0.0, 0.0}, {width, height}), LineStyle::chain, kGrey);
  const double low = height + kTitle;
  const auto line = [&](Vec2 from, Vec2 to) {
    pen.add(layer, {{{from}, {to}}, false}, LineStyle::continuous, kGrey);
  };
  line({0.0, low + 0.5 * kTitle}, {kBar, low + 0.5 * kTitle});
  for (const double x : {0.0, kBar}) line({x, low}, {x, low + kTitle});
  const std::string title = "100 mm     " + sheet.material + " " + length_text(sheet.thickness) + ", " +
                            length_text(sheet.stock.width) + " x " + length_text(sheet.stock.height) + ", " +
                            rounded_text(100.0 * sheet.utilisation, 3) + " % used";
  for (const ArcPath& stroke : stroked_text(title, {kBar + kTitle, low}, kTitle))
    pen.add(layer, stroke, LineStyle::continuous, kGrey);
}

}  // namespace

Drawing nest_drawing(const Workshop& workshop, const NestedSheet& sheet, LayerPreset preset) {
  Drawing drawing;
  drawing.name = "nest of " + sheet.material + ", " + length_text(sheet.thickness);
  CutPen pen(drawing, preset);
  for (const NestedPiece& piece : sheet.pieces)
    pen.pattern(workshop.parts[piece.part], piece.motion, {0.0, 0.0});
  if (pen.names().sheet != nullptr) add_sheet(pen, sheet);
  if (pen.names().label == nullptr) return drawing;
  for (const NestedPiece& piece : sheet.pieces) {
    const ShopPart& part = workshop.parts[piece.part];
    const auto label = label_of(part, room_for_label(part, piece.motion));
    if (label) add_text(pen, pen.names().label, *label);
  }
  return drawing;
}

}  // namespace glissade
