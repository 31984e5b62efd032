#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/core/vec.hpp"
#include "glissade/parts/shop_part.hpp"

#include "parts/bodies/brep.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// A round hole drilled square through a plate that follows a chain of lines and arcs: through planes, cylinders or cones.
/// In whichever unit its body has.
struct Bore {
  Vec3 centre;  ///< on the face where it begins
  Vec3 along;   ///< unit vectors: along the chain, across it in the face, into the plate
  Vec3 across;
  Vec3 into;
  double radius = 0.0;
  double depth = 0.0;  ///< of the plate
  /// Of the centre from the axis of its arc, and by how much that grows per length into and across the plate; 0: on a line.
  double from_axis = 0.0;
  double grows_into = 0.0;
  double grows_across = 0.0;
  std::size_t piece = 0;     ///< of the chain
  double path_radius = 0.0;  ///< of the chain there

  /// @return how far into the plate, from its centre, the face lies that passes `depth` below the centre
  /// @param x,y  along and across, from the hole's axis
  [[nodiscard]] double rise(double at_depth, double x, double y) const;
};

/// What a hole takes out of its plate.
struct BoreMoments {
  double volume = 0.0;
  Vec3 centroid;
};
/// @return by quadrature over the hole's circle, within 1e-13 of its volume
[[nodiscard]] BoreMoments moments(const Bore& bore);

/// @return what a hole takes out of a plate whose faces are cylinders of `radius` and radius + thickness, as a series in
///         (hole over radius)^2; of a flat one where the radius is infinite
/// @param radius  of the smaller cylinder; more than that of the hole
[[nodiscard]] double drilled_volume(double hole_radius, double thickness, double radius);

/// @return the same of any hole, by the areas that it cuts from the surfaces between the plate's faces
[[nodiscard]] double drilled_by_layers(const Bore& bore);

/// The line of a section that a hole begins on. Pairs are (to the left of the path, along z).
struct BoreLine {
  Vec2 foot;    ///< where y = 0 stands
  Vec2 across;  ///< unit direction of y; the plate lies to its left
  double thickness = 0.0;
};
/// @param piece  of the path
/// @return the line of a swept plate on which its holes and windows there are told
[[nodiscard]] BoreLine first_edge(const SweptBody& body, std::size_t piece);

/// Where a place along a path lies.
struct PieceAt {
  std::size_t piece = 0;
  double begins = 0.0;  ///< that piece, along the path
};
/// @return of a joint the piece before it
[[nodiscard]] PieceAt piece_at(const std::vector<PathPiece>& pieces, double place);

/// @param pieces  of a path in the x-y plane
/// @param hole    x: arc length along the path; y: along the line
[[nodiscard]] Bore bore_at(const std::vector<PathPiece>& pieces, const Circle& hole, const BoreLine& line);

/// @return the holes of a body; none of one that is drilled otherwise
[[nodiscard]] std::vector<Bore> bores_of(const SweptBody& body);
[[nodiscard]] std::vector<Bore> bores_of(const RolledSheet& sheet);

/// Adds the wall of a hole to a solid, in the solid's unit.
/// @return its edges in the face where it begins and in the other one, as those faces use them
struct BoreLoops {
  BrepUse face;
  BrepUse back;
};
BoreLoops add_bore(Brep& brep, const Bore& bore);

/// A mouth as a rational B-spline of two Bezier pieces of one degree, half a turn each: on the hole's cylinder exactly.
struct RationalCurve {
  std::size_t degree = 0;
  std::vector<Vec3> poles;  ///< 2 degree + 1
  std::vector<double> weights;
};
[[nodiscard]] RationalCurve rational_mouth(const BrepEdge& edge);

}  // namespace glissade::parts
