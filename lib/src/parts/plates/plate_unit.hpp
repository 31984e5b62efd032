#pragma once

#include "glissade/parts/plates.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/bodies/facets.hpp"
#include "parts/curves/offset_line.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// Everything that the parts of one channel are made from.
struct Job {
  const ArcSpline& track;
  const ChannelMeasures& channel;
  const PlateOptions& options;
  const Placement& placement;
};

/// @return level directions of a placement: to the left of the run, along it
[[nodiscard]] Vec3 across(const Placement& placement);
[[nodiscard]] Vec3 along(const Placement& placement);
/// @return points and directions of the plane (x, height) in space
[[nodiscard]] Vec3 in_space(const Placement& placement, Vec2 point);
[[nodiscard]] Vec3 direction_in_space(const Placement& placement, Vec2 direction);

/// @return inner radius of the bends
[[nodiscard]] double bend_radius(const Job& job);
/// @return neutral fibre of the floor, from the inside of each bend
[[nodiscard]] double neutral_fibre(const Job& job);
/// @return heights between which the walls stand
[[nodiscard]] Span wall_heights(const Job& job);
/// @return how far the floor plate's upper face lies below the track: by its liner
[[nodiscard]] double floor_depth(const Job& job);

/// @return the plane (x, height) of the track, moved across: z of the frame counts to the right of the body
/// @param shift  to the right [m]
[[nodiscard]] Frame plane_of_track(const Placement& placement, Vec2 origin, double angle, double shift);

/// A plate that stands in the plane of the track.
/// @param region  in the frame (x, height)
/// @param shifts  of the pieces, to the right [m]
[[nodiscard]] ShopPart upright_plate(const Job& job, const PlaneRegion& region, double depth,
                                     const std::vector<double>& shifts);

/// The least rectangle round a region lies along the axes with its lower left corner at the origin, x along the plate.
struct OwnPlane {
  Vec2 origin;
  double angle = 0.0;
};
[[nodiscard]] OwnPlane own_plane(const ArcPath& outline);
/// @return from the plane of the track into a part's own
[[nodiscard]] PlaneMotion into(const OwnPlane& plane);

/// @return where what was moved into its own plane lies, of a place of the plate that it was told in
[[nodiscard]] Frame moved_into(const Frame& place, const OwnPlane& own);

/// The face of a unit's floor: of the track's arcs, or of flats and bends. From its own origin.
struct FloorFace {
  ArcSpline line;
  Vec2 origin;
  std::optional<Facets> facets;
};
/// @param depth  below the track
[[nodiscard]] FloorFace rolled_face(const ArcSpline& track, const Span& span, double depth = 0.0);
[[nodiscard]] FloorFace bent_floor_face(const Job& job, Facets facets);

/// The floor of a unit, its pattern and the steps that make it.
/// @param tabs  along the face (corners.hpp)
[[nodiscard]] ShopPart floor_plate(const Job& job, const FloorFace& face, const std::vector<Span>& tabs,
                                   std::vector<BendStep>& steps);
/// Makes the finished floor one with holes, which its pattern has already.
/// @param holes  along the face, and across from its left edge
void drill_floor(const Job& job, const FloorFace& face, const std::vector<Span>& tabs,
                 std::vector<Circle> holes, ShopPart& floor);
/// @return none where the wall folds away: its length at the top is nothing
[[nodiscard]] std::optional<ShopPart> wall_plate(const Job& job, const Span& span, const FloorFace& face,
                                                 const std::vector<Span>& tabs);

/// Both walls of a region of the plane (x, height), with their pattern.
[[nodiscard]] ShopPart wall_of(const Job& job, const PlaneRegion& region);

/// What goes round the channel from the top of one wall to that of the other; without holes.
/// @param width  from the channel outwards
/// @param top    height to which it reaches; no more than 0: a bar below the floor
/// @param over_laps  with room for plates that reach beyond their corners
[[nodiscard]] PlaneRegion frame_region(const Job& job, double width, double top, bool over_laps);

/// A line in it (frame_pieces.hpp), from the left end to the right one.
[[nodiscard]] ArcPath frame_line(const Job& job, double width, double top);

/// A frame round the end of a unit, of one plate.
/// @param of_joint  the side on which it lies, which its holes tell
/// @param places  arc lengths of its upstream faces, each with the sense in which it grows: +1 downstream
[[nodiscard]] ShopPart frame_plate(const Job& job, FlangeSide of_joint, const std::vector<Frame>& places);
/// @return where a frame stands: x to the left, y up, z downstream; its face towards the unit's end at s
/// @param downstream  true: it lies downstream of the place
[[nodiscard]] Frame frame_place(const Job& job, double s, bool downstream);

/// @return length of a rolled or bent plate on the flat, of a stretch of its face
[[nodiscard]] double flat_length(const TrackArc& arc, double thickness, double neutral, bool bent);

}  // namespace glissade::parts
