#pragma once

#include "glissade/parts/shop_part.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// @return the unit tangent of a piece at a share of its length
[[nodiscard]] Vec2 tangent_at(const PathPiece& piece, double share);

/// @return how much farther along y a place stands on the lower face of a sheet than on the upper one
[[nodiscard]] double bevel_at(const RolledSheet& sheet, double y);
/// @return a place of a sheet's section: to the left of its path, along z
/// @param upper  on the upper face; else on the lower one
[[nodiscard]] Vec2 sheet_place(const RolledSheet& sheet, double y, bool upper);

/// @return at the joints of a sheet's path and both its ends, by how much what lies beside is shorter per length to the left:
///         tangents of half the bends between lines; 0 between others
[[nodiscard]] std::vector<double> mitres_of(const RolledSheet& sheet);

/// A body's volume with its first moments, in its own frame.
struct BodyMoments {
  double volume = 0.0;  ///< [m^3]
  Vec3 centroid;
};

/// @return of a prism exactly; of a section along lines and arcs by Pappus' theorem, its centroid by quadrature within 1e-12 of
///         its length; of a gore exactly
[[nodiscard]] BodyMoments moments(const PartBody& body);

/// Fills in volume, mass and centre of gravity of a part.
void weigh(ShopPart& part);

/// @return points just inside a body along its edges, in its own frame
/// @param inset  of the points from the faces [m]
[[nodiscard]] std::vector<Vec3> edge_points(const PartBody& body, double inset);

/// @return how deep a point lies inside a body [m]; negative outside, no less than minus its distance
[[nodiscard]] double depth_inside(const PartBody& body, Vec3 point);

/// Holds points along the edges of every piece against the insides of all others.
/// @return how many pairs were looked at
/// @throws InternalError if two parts clash: which, and by how much
std::size_t require_no_clash(const Workshop& workshop);

}  // namespace glissade::parts
