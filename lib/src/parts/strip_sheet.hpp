#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/bent_strips.hpp"
#include "parts/section_corners.hpp"
#include "parts/strip_shape.hpp"

#include <vector>

namespace glissade::parts {

/// A plate of a section of one width along a stretch of track, on the flat. Places are (arc length of the track, y along the
/// plate's face from `face_from`) and lie in the middle of the thickness.
class StripFlat {
 public:
  StripFlat(const StripJob& job, const SectionPlate& plate, const Span& span);

  [[nodiscard]] Vec2 at(double s, double y) const;
  /// Adds the corners of an edge along the plate, but for its last one.
  void append_edge(double from, double to, double y, ArcPath& path) const;
  /// @return the length of such an edge as it is in space
  [[nodiscard]] double finished_length(double from, double to, double y) const;
  /// @return where arcs begin [m]
  [[nodiscard]] const std::vector<TrackArc>& arcs() const { return arcs_; }

 private:
  [[nodiscard]] double heading(double s) const;
  [[nodiscard]] double height(double y) const { return foot_ + rise_ * y; }

  std::vector<TrackArc> arcs_;
  std::vector<Vec2> starts_;  ///< of arcs, at y = 0
  std::vector<double> headings_;
  double foot_ = 0.0;  ///< height at y = 0, in the middle of the thickness
  double rise_ = 0.0;  ///< of it per y
};

/// A rectangle that is cut out square to the sheet.
struct SheetOpening {
  Span along;   ///< of the track, on one arc
  Span across;  ///< y, ascending
};

/// What is cut from a plate of a section over a stretch.
struct SheetCut {
  const SectionPlate* plate = nullptr;
  double thickness = 0.0;
  StockMaterial material;
  CorneredPlate edges;
  Span span;                  ///< of the track
  Span laps;                  ///< where edges that pass reach out; nothing: from 0 to 0
  std::vector<Span> tabs;     ///< along the track
  double slack = 0.0;         ///< by which slots are longer than tabs, at either end [m]
  std::vector<Circle> holes;  ///< (arc length of the track, y)
  std::vector<SheetOpening> openings = {};
};

/// Its body, pattern, weight and place.
/// @param radii  to which arcs are rolled (pattern_of())
/// @param edge_mismatch  is raised to the greatest difference of an edge on the flat from what it is finished
[[nodiscard]] ShopPart sheet_part(const StripJob& job, const SheetCut& cut, const std::vector<double>& radii,
                                  double& edge_mismatch);

/// A plate as it is, without laps and tabs, its edges as the section has them.
/// @param thickness  as its stock has it: of the corners, rounding is left
[[nodiscard]] SheetCut plain_cut(const SectionPlate& plate, double thickness, const Span& span,
                                 const StockMaterial& material);

/// Area and moment about the floor line of a stretch of a plate's section.
[[nodiscard]] Vec2 stretch_moments(const SectionPlate& plate, double thickness, const Bevel& from,
                                   const Bevel& to);

}  // namespace glissade::parts
