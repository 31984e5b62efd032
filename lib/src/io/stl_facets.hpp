#pragma once

#include "io/coordinates.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace glissade::io {

/// Puts triangles down as the facets of binary STL: unit normal, three corners, two bytes of zero.
///
/// Normals are those of the corners put down, worked out in double precision and rounded once; (0, 0, 0) where
/// a facet has no area.
/// @param place  where the first facet goes; the kBytesBeyondFacets after the last one are overwritten
/// @param begin,end  triangles of vertices that exist
/// @param vertices  [m]; rounded to single precision in the file's unit, of which `per_metre` are one metre
/// @return where the next facet would go
[[nodiscard]] char* put_stl_facets(char* place, const std::array<std::uint32_t, 3>* begin,
                                   const std::array<std::uint32_t, 3>* end, const std::vector<Vec3>& vertices,
                                   double per_metre);

inline constexpr std::size_t kBytesBeyondFacets = 2;

}  // namespace glissade::io
