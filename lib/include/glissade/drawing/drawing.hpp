#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/core/units.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace glissade {

/// What a drawing shows, in millimetres of the real thing (1:1), x to the right and y up. DXF, PDF and SVG are written
/// from it; scale and paper belong to the sheet that shows it.

/// How a line is drawn (ISO 128).
enum class LineStyle { continuous, dashed, chain };

/// Lines of one purpose.
struct DrawingLayer {
  std::string name;  ///< ASCII: letters, digits, "_", "-"
  LineStyle style = LineStyle::continuous;
  double width_mm = 0.25;  ///< of its lines, on paper
  int colour = 7;          ///< AutoCAD colour index, 1 to 255; 7 is black on paper
};

/// Which point of a text lies at its place.
enum class TextAnchor { left, centre, right };

/// Lines and arcs on a layer.
struct DrawnPath {
  std::size_t layer = 0;
  ArcPath path;
  int colour = 0;                       ///< instead of the layer's; 0: that of the layer
  std::optional<LineStyle> style = {};  ///< instead of the layer's
  bool filled = false;                  ///< on paper, black or a grey of 250 to 255; DXF has outlines alone
};

/// A circle on a layer.
struct DrawnCircle {
  std::size_t layer = 0;
  Circle circle;
};

/// A line of text. On paper it has its height whatever the scale; a DXF holds it times the drawing's text scale.
struct DrawnText {
  std::size_t layer = 0;
  Vec2 at;                 ///< of the base line, at its anchor
  double height_mm = 2.5;  ///< of capital letters, on paper
  std::string text;        ///< UTF-8
  TextAnchor anchor = TextAnchor::left;
  Angle angle;  ///< of the base line, counter-clockwise
};

/// What a dimension measures.
enum class DimensionKind { aligned, level, upright };

/// A distance with its two extension lines, arrows and number.
struct DrawnDimension {
  std::size_t layer = 0;
  Vec2 from;
  Vec2 to;
  double offset_mm =
      8.0;  ///< of the dimension line on paper, from the points; to the left of from -> to where positive
  DimensionKind kind = DimensionKind::aligned;
  std::string text;  ///< empty: the distance in millimetres, to a tenth
};

/// A figure in millimetres: shapes, texts and dimensions on layers.
struct Drawing {
  std::string name;
  std::vector<DrawingLayer> layers;
  std::vector<DrawnPath> paths;
  std::vector<DrawnCircle> circles;
  std::vector<DrawnText> texts;
  std::vector<DrawnDimension> dimensions;
  /// Real millimetres to one of paper, for the height of texts and offsets of dimensions where there is no paper (DXF):
  /// 20 for a drawing thought of at 1:20.
  double text_scale = 1.0;

  /// @return the index of the layer with this name; a new one where there is none
  std::size_t layer(const DrawingLayer& wanted);

  Drawing& add(std::size_t layer, ArcPath path);
  Drawing& add(std::size_t layer, const Circle& circle);
  /// Outline, cutouts and holes.
  Drawing& add(std::size_t layer, const PlaneRegion& region);
  Drawing& line(std::size_t layer, Vec2 from, Vec2 to);
};

/// A dimension as what is drawn of it.
struct DimensionLines {
  std::vector<ArcPath> lines;   ///< extension lines and the dimension line
  std::vector<ArcPath> arrows;  ///< closed, to be filled or outlined
  DrawnText text;
};

/// @param scale  paper over real size: 0.05 for 1:20; > 0
/// @return lines and text of a dimension in real millimetres; its text height stays in those of paper
[[nodiscard]] DimensionLines lines_of(const DrawnDimension& dimension, double scale);

/// @return the same drawing with its dimensions as lines and texts, for 1 : Drawing::text_scale
[[nodiscard]] Drawing without_dimensions(const Drawing& drawing);

/// @return the least rectangle that holds every path and circle; none where there are none
[[nodiscard]] std::optional<PlaneBox> bounds(const Drawing& drawing);

/// Text as single strokes, for marks that a cutter or engraver follows: pen paths of lines and arcs.
/// Character set: printable ASCII and the letters of German and French; others become a box.
/// @param height  of capital letters, in the unit of the drawing
[[nodiscard]] std::vector<ArcPath> stroked_text(const std::string& text, Vec2 at, double height,
                                                Angle angle = {}, TextAnchor anchor = TextAnchor::left);
/// @return how wide stroked_text() gets
[[nodiscard]] double stroked_width(const std::string& text, double height);

}  // namespace glissade
