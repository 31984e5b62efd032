#pragma once

#include "glissade/core/vec.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace glissade {

/// A surface of triangles that share vertices by index.
///
/// Units: metres, z up. Winding: counter-clockwise seen from outside, so that the normal (b - a) x (c - a) of
/// a triangle {a, b, c} points out of the material. Example: vertices {(0,0,0), (1,0,0), (0,1,0), (0,0,1)}
/// with triangles {0,2,1}, {0,1,3}, {0,3,2}, {1,2,3} are a tetrahedron of volume 1/6.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace glissade
