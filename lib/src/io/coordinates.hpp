#pragma once

#include "glissade/core/units.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <array>
#include <stop_token>
#include <string_view>
#include <vector>

namespace glissade::io {

using FloatPosition = std::array<float, 3>;

/// @return the nearest position in single precision. Adding +0 turns -0 into +0: files hold one zero.
[[nodiscard]] inline FloatPosition nearest(Vec3 p) {
  return {static_cast<float>(p.x) + 0.0F, static_cast<float>(p.y) + 0.0F, static_cast<float>(p.z) + 0.0F};
}

/// @return for a header: "origin at (1, 2, 3) m of the site"
[[nodiscard]] std::string offset_in_words(Vec3 offset);

/// @throws InputError if a triangle names a vertex that does not exist or a coordinate is not finite
///         or beyond kLargestMeshCoordinate
/// @throws Interrupted if `stop` asks for it
void require_writable(const TriangleMesh& mesh, const std::stop_token& stop);

/// @throws InputError if there is no facet: read_mesh() takes no such file for a mesh
void require_facets(const TriangleMesh& mesh);

/// @return whether the vertices are as as_written() makes them for binary STL: each coordinate is a number of
///         single precision in the file's unit, up to its conversion to metres
/// @throws InputError if a coordinate is not finite or does not fit single precision
/// @throws Interrupted if `stop` asks for it
[[nodiscard]] bool is_single_precision(const TriangleMesh& mesh, LengthUnit unit,
                                       const std::stop_token& stop);

/// @return the vertices of as_written() for binary STL [m]
/// @throws InputError as as_written(); triangles must name vertices that exist
/// @throws Interrupted if `stop` asks for it
[[nodiscard]] std::vector<Vec3> single_precision(const TriangleMesh& mesh, LengthUnit unit,
                                                 const std::stop_token& stop);

}  // namespace glissade::io
