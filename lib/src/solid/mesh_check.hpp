#pragma once

#include "glissade/solid/triangle_mesh.hpp"

#include <cstddef>
#include <string_view>

namespace glissade::solid {

/// What every function that takes a mesh asks of it first. Ranges, so that several threads can share the work.

/// @param use  what cannot be done with other coordinates: "measured", "written"
/// @throws InputError if a coordinate of vertices [first, last) is not finite or beyond
///         kLargestMeshCoordinate; names the first such vertex
void require_usable_positions(const TriangleMesh& mesh, std::size_t first, std::size_t last,
                              std::string_view use);

/// @throws InputError if one of the triangles [first, last) names a vertex that does not exist; names the
///         first such triangle
void require_existing_vertices(const TriangleMesh& mesh, std::size_t first, std::size_t last);

}  // namespace glissade::solid
