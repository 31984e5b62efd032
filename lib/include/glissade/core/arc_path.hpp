#pragma once

#include "glissade/core/vec.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace glissade {

/// Plane figures of straight lines and circular arcs, as cutters, printers and solids take them.
///
/// Frame: any plane with x to the right and y up. Unit: whoever holds a path says it; parts hold metres, drawings
/// millimetres.
/// An arc is held as the bulge of its piece, so that both ends are exact and shared by whatever else touches them.

/// A corner of a path, and how the path goes on from there to the next corner.
struct PathVertex {
  Vec2 at;
  /// tan(sweep / 4) of the piece that starts here: positive to the left (counter-clockwise), 0: a straight line.
  double bulge = 0.0;

  friend constexpr bool operator==(const PathVertex&, const PathVertex&) = default;
};

/// One straight line or arc.
struct PathPiece {
  Vec2 from;
  Vec2 to;
  double bulge = 0.0;  ///< tan(sweep / 4)

  [[nodiscard]] bool straight() const { return bulge == 0.0; }
  friend constexpr bool operator==(const PathPiece&, const PathPiece&) = default;
};

/// A chain of lines and arcs. Of a closed one the last vertex leads to the first; of an open one its bulge is not
/// looked at.
struct ArcPath {
  std::vector<PathVertex> vertices;
  bool closed = false;

  friend bool operator==(const ArcPath&, const ArcPath&) = default;
};

/// A circle in the plane.
struct Circle {
  Vec2 centre;
  double radius = 0.0;

  friend constexpr bool operator==(const Circle&, const Circle&) = default;
};

/// What is inside a closed outline and outside every cutout and hole. Which way round a path runs does not matter.
struct PlaneRegion {
  ArcPath outline;
  std::vector<ArcPath> cutouts;  ///< closed: slots, openings
  std::vector<Circle> holes;

  friend bool operator==(const PlaneRegion&, const PlaneRegion&) = default;
};

/// An arc by its circle.
struct CircularArc {
  Vec2 centre;
  double radius = 0.0;
  double start_angle = 0.0;  ///< of its first point, from +x to +y [rad]
  double sweep = 0.0;        ///< positive: counter-clockwise [rad]
};

/// A rectangle along the axes; empty where low lies above high.
struct PlaneBox {
  Vec2 low;
  Vec2 high;

  [[nodiscard]] double width() const { return high.x - low.x; }
  [[nodiscard]] double height() const { return high.y - low.y; }
};

/// How much area, and where.
struct AreaMoments {
  double area = 0.0;
  Vec2 centroid;
};

/// A turn (and mirroring before it) about the origin, then a move.
struct PlaneMotion {
  double cosine = 1.0;
  double sine = 0.0;
  Vec2 shift;
  bool mirrored = false;  ///< y becomes -y first

  [[nodiscard]] static PlaneMotion turn(double angle, Vec2 shift = {});
  [[nodiscard]] Vec2 operator()(Vec2 point) const;
};

/// @param sweep  of an arc [rad]; within +-2 pi
/// @return its bulge
[[nodiscard]] double bulge_of_sweep(double sweep);

/// @param piece  not straight
/// @return its circle; error of centre and radius: some units in the last place of the radius
[[nodiscard]] CircularArc arc_of(const PathPiece& piece);

/// @return the lines and arcs of a path in their order; none of fewer than two vertices
[[nodiscard]] std::vector<PathPiece> pieces_of(const ArcPath& path);

/// @param share  0 at its start, 1 at its end
[[nodiscard]] Vec2 point_on(const PathPiece& piece, double share);

[[nodiscard]] double length(const PathPiece& piece);
[[nodiscard]] double length(const ArcPath& path);

/// @return the area inside a closed path: positive where it runs counter-clockwise
[[nodiscard]] double signed_area(const ArcPath& path);

/// @return area and centre of area of a region by Green's theorem, exact but for rounding
[[nodiscard]] AreaMoments moments(const PlaneRegion& region);

/// @return the least rectangle that holds the path, arcs included
[[nodiscard]] PlaneBox bounds(const ArcPath& path);

/// @return the same figure the other way round
[[nodiscard]] ArcPath reversed(const ArcPath& path);

[[nodiscard]] ArcPath moved(const ArcPath& path, const PlaneMotion& motion);
[[nodiscard]] PlaneRegion moved(const PlaneRegion& region, const PlaneMotion& motion);

/// @param factor  > 0, e.g. 1000 from metres to millimetres
[[nodiscard]] ArcPath scaled(const ArcPath& path, double factor);
[[nodiscard]] PlaneRegion scaled(const PlaneRegion& region, double factor);

/// @return a circle as two half circles, counter-clockwise
[[nodiscard]] ArcPath path_of(const Circle& circle);
/// @return a rectangle along the axes, counter-clockwise from `low`
[[nodiscard]] ArcPath rectangle(Vec2 low, Vec2 high);

/// @param sagitta  largest distance between an arc and its chord; > 0
/// @return points on the path, every vertex among them; the first again at the end of a closed one
[[nodiscard]] std::vector<Vec2> flattened(const ArcPath& path, double sagitta);

/// @return whether a point lies inside a closed path; on the path itself, either
[[nodiscard]] bool contains(const ArcPath& path, Vec2 point);

/// @return the least distance between two pieces; 0 where they touch or cross
[[nodiscard]] double distance(const PathPiece& a, const PathPiece& b);
/// @return the least distance between two paths' lines and arcs (not their insides)
[[nodiscard]] double distance(const ArcPath& a, const ArcPath& b);

/// What keeps a region from being cut, in words, one sentence each; empty: nothing. Looked for: open paths, pieces of
/// no length, a sweep of a full turn, values that are not finite, an outline or cutout that meets itself, cutouts and
/// holes that touch one another or reach outside.
[[nodiscard]] std::vector<std::string> faults_of(const PlaneRegion& region);

}  // namespace glissade
