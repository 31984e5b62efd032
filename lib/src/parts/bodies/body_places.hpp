#pragma once

#include "glissade/parts/shop_part.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace glissade::parts {

/// Where the parts of a body lie in its own frame: of a path its tangents, of a sheet the places of its section, of a
/// folded plate the planes of its facets. In whichever unit the body has.

/// @return the unit tangent of a piece at a share of its length
[[nodiscard]] Vec2 tangent_at(const PathPiece& piece, double share);
/// @return the arc lengths at which the pieces of a path begin, and that of its end
[[nodiscard]] std::vector<double> starts_of(const std::vector<PathPiece>& pieces);

/// @return the section of a body at a share of a piece of its path
[[nodiscard]] std::vector<Vec2> section_at(const SweptBody& body, std::size_t piece, double share);

/// @return the figure with these corners
[[nodiscard]] PlaneRegion polygon_of(const std::vector<Vec2>& corners);

/// @return how much farther along y a place stands on the lower face of a sheet than on the upper one
[[nodiscard]] double bevel_at(const RolledSheet& sheet, double y);
/// @return a place of a sheet's section: to the left of its path, along z
/// @param upper  on the upper face; else on the lower one
[[nodiscard]] Vec2 sheet_place(const RolledSheet& sheet, double y, bool upper);
/// @return at the joints of a sheet's path and both its ends, by how much what lies beside is shorter per length to the left:
///         tangents of half the bends between lines; 0 between others
[[nodiscard]] std::vector<double> mitres_of(const RolledSheet& sheet);

/// Six outward planes of a facet of a folded plate; the last two lie at its bends or ends.
struct FacetPlanes {
  std::array<Vec3, 6> origins;
  std::array<Vec3, 6> outward;
};
[[nodiscard]] FacetPlanes planes_of(const std::array<Vec3, 4>& from, const std::array<Vec3, 4>& to);

}  // namespace glissade::parts
