#pragma once

#include "glissade/parts/plates.hpp"

#include "parts/curves/offset_line.hpp"
#include "parts/plates/plate_section.hpp"

#include <vector>

namespace glissade::parts {

/// Where a stretch of track begins and ends, how it bends, and how a section that widens stands at both ends.
struct StripArc {
  TrackArc arc;
  double wide_from =
      0.0;  ///< by how much each half of the section stands farther out than the narrowest one [m]
  double wide_to = 0.0;
  double lean_from = 0.0;  ///< by how much it leans out more, across per height [-]
  double lean_to = 0.0;
  /// Of a flat: by how much it is shorter per height at both ends, where it meets another one at a bend.
  double mitre_from = 0.0;
  double mitre_to = 0.0;

  /// Of the foot of a wall, out per length of track.
  [[nodiscard]] double taper() const { return (wide_to - wide_from) / arc.length; }
};

class FlatsLine;

/// Everything that the strips of one section are made from.
///
/// Where the width changes, a wall through both of its edges at equal heights is no developable surface in a bend. One that
/// leans is, if its lean across per height changes by -kappa b' along the track, b' being the taper of its half: the ruling
/// at a place is then N + lean Y, and a' x d . d' = 0. Every plate of a half of the section gets the same shear, so plates
/// that meet go on meeting. It is spread so that the greatest lean to either side is as small as can be.
class StripJob {
 public:
  /// @throws InputError where a width makes walls lean or taper more than they may: the place, the bound, a way out
  StripJob(const ArcSpline& track, const PlateSection& section, const PlateOptions& options,
           const Placement& placement);
  /// Along the flats of a bent job, of one width: their line stands for the track, and its places for those on the track.
  StripJob(const FlatsLine& flats, const PlateSection& section, const PlateOptions& options,
           const Placement& placement);

  const ArcSpline& track;
  const PlateSection& section;
  const PlateOptions& options;
  const Placement& placement;

  [[nodiscard]] bool bent() const { return flats_ != nullptr; }
  /// @return the place on the track of one along `track`
  [[nodiscard]] double on_track(double place) const;
  /// @return what things at these heights leave of either side of each joint of the line's flats, off its bend; nothing of a track
  [[nodiscard]] std::vector<double> rooms_at_bends(const Span& heights) const;
  /// @return a place, moved on by sense (+1 downstream) until it is off all bends
  [[nodiscard]] double off_bends(double place, double sense, const Span& heights) const;
  [[nodiscard]] bool widens() const { return section.widths.has_value(); }
  /// @return arcs of the track within a span, cut where the width begins or ends to change and where they turn far
  [[nodiscard]] std::vector<StripArc> arcs_in(const Span& span) const;
  /// @return by how much the line at a height above the floor line is shorter than that within a span; negative where it is longer [m]
  [[nodiscard]] double lost_at(const Span& span, double height) const;
  /// @return by how much half the section is wider than at its narrowest, and how it leans, at a place
  [[nodiscard]] double wider_at(double s) const;
  [[nodiscard]] double lean_at(double s) const;
  /// @return where a corner of the section stands
  [[nodiscard]] Vec2 at(Vec2 corner, double wider, double lean) const;
  /// @return places where the pieces of bodies beside a width that changes begin
  [[nodiscard]] std::vector<double> pieces() const;
  /// @return greatest lean, and greatest distance of walls from where the width has them [m]
  [[nodiscard]] double most_lean() const { return most_lean_; }
  [[nodiscard]] double departure() const;
  [[nodiscard]] double most_taper() const { return most_taper_; }

 private:
  const FlatsLine* flats_ = nullptr;
  std::vector<StripArc> arcs_;
  double most_lean_ = 0.0;
  double most_taper_ = 0.0;
};

/// A strip on the flat, from the middle of its upstream edge at `face_to` on.
struct Development {
  std::vector<Vec2> base;   ///< at the side of `face_to`
  std::vector<Vec2> upper;  ///< at the side of `face_from`
  std::vector<double> turns;
  std::vector<BendLine> folds;  ///< where a width begins or ends to change, pressed along rulings
  double pressed =
      0.0;  ///< by how much both edges are shorter than in the body, where folds are without a radius [m]
  std::vector<Circle> holes = {};
  std::vector<ArcPath> cutouts = {};
};

/// The stretch of track over which a plate stands unfolded; beyond it, at either end, the radius is less than its height.
/// @throws InputError if it folds over farther from the ends: names the place and the height that would do
[[nodiscard]] Span unfolded(const StripJob& job, const SectionPlate& plate);

/// The finished strip: x counts upwards from the track, z to the right of the section's middle.
/// @param origin  gets the upstream end of its floor line, in the frame (x, height)
[[nodiscard]] SweptBody strip_body(const StripJob& job, const SectionPlate& plate, const Span& span,
                                   Vec2& origin);

/// @return the place on the pattern of a level plate of one along the track, and y along its face where it is narrowest
[[nodiscard]] Vec2 on_level(const StripJob& job, const SectionPlate& plate, const Span& span, Vec2 place);

[[nodiscard]] Development developed(const StripJob& job, const SectionPlate& plate, const Span& span);

/// @return the length of a chain of arcs through places that turn so
[[nodiscard]] double length_along(const std::vector<Vec2>& places, const std::vector<double>& turns);

/// A plate's face at a place beside a width that changes.
struct FaceAt {
  Vec2 from;  ///< where `face_from` stands
  Vec2 way;   ///< unit direction along the face
};
[[nodiscard]] FaceAt face_at(const StripJob& job, const SectionPlate& plate, double s);

/// A rectangle that is cut out square to a plate.
struct SheetOpening {
  Span along;   ///< of the track, on one arc
  Span across;  ///< y, ascending
};

/// Holes and openings through a plate beside a width that changes: in its body and on the flat. Those of plates that are not level lie
/// where it does not change.
/// @param holes     of a level plate as on_level(); else y along its face as it stands there
/// @param openings  y as of holes
void cut_through(const StripJob& job, const SectionPlate& plate, const Span& span,
                 const std::vector<Circle>& holes, const std::vector<SheetOpening>& openings, SweptBody& body,
                 Development& flat);

/// @return stretches of the track within a span along which the width does not change, longer than nothing
[[nodiscard]] std::vector<Span> even_stretches(const StripJob& job, const Span& span);

/// @param radii  to which each arc is rolled; empty: none is
[[nodiscard]] FlatPattern pattern_of(const Development& strip, const std::vector<double>& radii);

}  // namespace glissade::parts
