#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/plates/section_corners.hpp"
#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_shape.hpp"

#include <vector>

namespace glissade::parts {

/// What a bend of the line makes of a plate.
struct FlatBend {
  double angle = 0.0;  ///< positive towards the face [rad]
  double cut = 0.0;    ///< bend_cut()
  bool pressed = false;
};

/// A plate of a section of one width along a stretch of track, on the flat. Places are (arc length of the track, y along the
/// plate's face from `face_from`) and lie in the middle of the thickness.
class StripFlat {
 public:
  /// @param thickness  of the plate: bends take of it
  StripFlat(const StripJob& job, const SectionPlate& plate, const Span& span, double thickness);

  [[nodiscard]] Vec2 at(double s, double y) const;
  /// Adds the corners of an edge along the plate, but for its last one.
  void append_edge(double from, double to, double y, ArcPath& path) const;
  /// @return the length of such an edge as it is in space
  [[nodiscard]] double finished_length(double from, double to, double y) const;
  /// @return where arcs begin [m]
  [[nodiscard]] const std::vector<TrackArc>& arcs() const { return arcs_; }
  /// @return of a bent plate, one where each arc begins; none of a rolled one
  [[nodiscard]] const std::vector<FlatBend>& bends() const { return bends_; }

 private:
  [[nodiscard]] double height(double y) const { return foot_ + rise_ * y; }
  /// A place on a flat, the distance from where it begins told; on a bend it lies on the bend's line.
  [[nodiscard]] Vec2 on_flat(std::size_t i, double along, double y) const;
  /// @return from where to where a flat reaches on the pattern, along an edge
  [[nodiscard]] Span reach(std::size_t i, double y) const;
  [[nodiscard]] Vec2 at_bends(double s, double y) const;
  void fold(const StripJob& job, const SectionPlate& plate, double thickness);

  std::vector<TrackArc> arcs_;
  std::vector<double> mitres_;   ///< of bent plates, where arcs begin and at the end
  std::vector<FlatBend> bends_;  ///< at the same places
  bool bent_ = false;
  std::vector<Vec2> starts_;  ///< of arcs, at y = 0
  std::vector<double> headings_;
  double foot_ = 0.0;  ///< height at y = 0, in the middle of the thickness
  double rise_ = 0.0;  ///< of it per y
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
