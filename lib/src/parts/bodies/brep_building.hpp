#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/vec.hpp"

#include "core/millimetres.hpp"
#include "parts/bodies/brep.hpp"

#include <array>
#include <cstddef>
#include <string>

namespace glissade::parts {

/// Vertices, edges and faces of solids in the making. Millimetres.

inline constexpr Vec3 kUp{0.0, 0.0, 1.0};
inline constexpr Vec3 kDown{0.0, 0.0, -1.0};
inline constexpr Vec3 kAcross{1.0, 0.0, 0.0};

[[nodiscard]] Vec3 at_height(Vec2 point, double z);
[[nodiscard]] Vec3 unit(Vec3 direction);
/// @return what says that the body of a part is none
[[nodiscard]] InputError bad_body(const ShopPart& part, const std::string& what);

/// @return its index
std::size_t add_vertex(Brep& brep, Vec3 point);
std::size_t add_line(Brep& brep, std::size_t from, std::size_t to);
/// Part of a circle that lies level, turning to the left or right.
std::size_t add_arc(Brep& brep, std::size_t from, std::size_t to, Vec2 centre, bool left);

/// A line round an upright axis that climbs evenly: a helix, as a cubic within 1e-7 of its radius up to 6 deg.
[[nodiscard]] std::array<Vec3, 4> helix_poles(Vec3 from, Vec3 to, Vec2 centre, double sweep);
std::size_t add_helix(Brep& brep, std::size_t from, std::size_t to, Vec2 centre, double sweep);

[[nodiscard]] BrepFace level_plane(double z, bool up);
[[nodiscard]] BrepFace upright_cylinder(Vec2 centre, Vec3 reference, double radius, bool outward);
/// The plane z = height + x slope.
[[nodiscard]] BrepFace ring_plane(double height, double slope, bool up);

/// What a line of a section makes along an arc: a plane, a cylinder or a cone.
/// @param from,to  (to the left of the path, along z); the solid lies to the left of the way between them
[[nodiscard]] BrepFace round_face(const PathPiece& arc, Vec2 from, Vec2 to);
/// The plane through a vertex and two others; seen from outside, `ahead` lies to the left of the way to `aside`.
[[nodiscard]] BrepFace flat_face(const Brep& brep, std::size_t at, std::size_t ahead, std::size_t aside);

/// @return unit tangents of a piece at its ends
[[nodiscard]] Vec2 start_tangent(const PathPiece& piece);
[[nodiscard]] Vec2 end_tangent(const PathPiece& piece);
/// @return the same closed path, running counter-clockwise where `left`
[[nodiscard]] ArcPath turning(const ArcPath& path, bool left);

[[nodiscard]] Brep brep_of_sheet(const RolledSheet& sheet, const ShopPart& part);
[[nodiscard]] Brep brep_of_angle(const AngleBar& bar, const ShopPart& part);
[[nodiscard]] Brep brep_of_tube(const TubeGore& gore, const ShopPart& part);
[[nodiscard]] Brep brep_of_trough(const TroughGore& gore, const ShopPart& part);

}  // namespace glissade::parts
