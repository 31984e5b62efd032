#pragma once

#include "glissade/core/vec.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <cstddef>
#include <optional>
#include <string_view>

namespace glissade::solid {

/// What every function that takes a mesh asks of it first. Ranges, so that several threads can share the work.

/// @param use  what cannot be done with other coordinates: "measured", "written"
/// @throws InputError if a coordinate of vertices [first, last) is not finite or beyond
///         kLargestMeshCoordinate; names the first such vertex
void require_usable_positions(const TriangleMesh& mesh, std::size_t first, std::size_t last,
                              std::string_view use);

/// Of the facets, not of vertices that none has [m].
struct MeshBox {
  Vec3 lower;
  Vec3 upper;
};

/// @param mesh  its vertices exist
/// @return both corners at the origin where there is no facet
[[nodiscard]] MeshBox box_of(const TriangleMesh& mesh);

/// @return the longest side where that is below kSmallestMeshSize and not 0, else none [m]
[[nodiscard]] std::optional<double> size_too_small(const MeshBox& box);

/// @throws InputError if size_too_small()
void require_measurable_size(const MeshBox& box);

/// @throws InputError if one of the triangles [first, last) names a vertex that does not exist; names the
///         first such triangle
void require_existing_vertices(const TriangleMesh& mesh, std::size_t first, std::size_t last);

}  // namespace glissade::solid
