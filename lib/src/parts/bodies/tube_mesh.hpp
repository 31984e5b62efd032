#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "parts/bodies/mesh_chords.hpp"

namespace glissade::parts {

/// @return the facets of a tube or trough between two planes, closed, outward, in its own frame
[[nodiscard]] TriangleMesh mesh_of(const TubeGore& gore, const Fineness& fineness);
[[nodiscard]] TriangleMesh mesh_of(const TroughGore& gore, const Fineness& fineness);

}  // namespace glissade::parts
