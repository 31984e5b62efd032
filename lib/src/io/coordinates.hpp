#pragma once

#include "glissade/design/design.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace glissade {

using FloatPosition = std::array<float, 3>;

/// @return how many of the unit are one metre
[[nodiscard]] double units_per_metre(LengthUnit unit);
/// @return "mm" or "m"
[[nodiscard]] std::string_view unit_symbol(LengthUnit unit);

/// @throws InputError if a triangle names a vertex that does not exist or a coordinate is not finite
///         or beyond kLargestMeshCoordinate
void require_writable(const TriangleMesh& mesh);

/// @return the positions of as_written() for binary STL, in the file's unit
/// @throws InputError as as_written()
[[nodiscard]] std::vector<FloatPosition> single_precision(const TriangleMesh& mesh, LengthUnit unit);

}  // namespace glissade
