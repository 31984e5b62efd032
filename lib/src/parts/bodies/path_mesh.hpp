#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "parts/bodies/mesh_chords.hpp"

namespace glissade::parts {

/// @return the facets of what follows a path, closed, outward, in its own frame
[[nodiscard]] TriangleMesh mesh_of(const SweptBody& body, const Fineness& fineness);
[[nodiscard]] TriangleMesh mesh_of(const RolledSheet& sheet, const Fineness& fineness);

}  // namespace glissade::parts
