#pragma once

#include "glissade/core/workshop_format.hpp"
#include "glissade/drawing/drawing.hpp"
#include "glissade/parts/shop_part.hpp"

namespace glissade::drawing {

/// Where lines of each purpose go; no name: they are left out.
struct CutLayers {
  const char* outline;
  const char* inside;
  const char* mark;
  const char* bend_up;
  const char* bend_down;
  const char* roll;
  const char* label;  ///< for reading: neither cut nor engraved
  const char* sheet;  ///< of a nest: edge, title, bar of 100 mm
};

[[nodiscard]] CutLayers layers_of(LayerPreset preset);

// AutoCAD colours.
inline constexpr int kBlack = 7;
inline constexpr int kGreen = 3;
inline constexpr int kRed = 1;
inline constexpr int kBlue = 5;
inline constexpr int kMagenta = 6;
inline constexpr int kGrey = 8;

/// Draws flat patterns as they are cut, 1:1 in millimetres, each line on the layer of its purpose.
class CutPen {
 public:
  CutPen(Drawing& drawing, LayerPreset preset) : drawing_(drawing), names_(layers_of(preset)) {}

  [[nodiscard]] const CutLayers& names() const { return names_; }

  /// Contour, cutouts, holes, bends, roll lines, marks and the part's number.
  /// @param motion  of the pattern [m]
  /// @param shift   after it [mm]
  void pattern(const ShopPart& part, const PlaneMotion& motion, Vec2 shift);

  /// Lines of one purpose, where they are [mm].
  /// @param name  of their layer; null: they are left out
  void add(const char* name, ArcPath path, LineStyle style, int colour);

 private:
  Drawing& drawing_;
  CutLayers names_;
};

}  // namespace glissade::drawing
