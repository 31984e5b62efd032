#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/solid/triangle_mesh.hpp"

#include "parts/bodies/mesh_chords.hpp"

namespace glissade::parts {

/// @return the facets of an angle, closed, outward, in its own frame
[[nodiscard]] TriangleMesh mesh_of(const AngleBar& bar, const Fineness& fineness);

}  // namespace glissade::parts
