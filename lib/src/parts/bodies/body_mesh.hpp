#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/solid/triangle_mesh.hpp"

namespace glissade::parts {

/// A part's body as facets: vertices of paths and sections are met exactly, arcs by chords on them. Where chords of arcs
/// beside each other would cross, finer ones are taken.
/// @param tolerance      greatest distance between an arc and its chord [m]; > 0
/// @param round_corners  chords of a full turn, at least; >= 3
/// @return closed, outward, in the part's own frame; of a MeshBody the mesh itself
/// @throws InternalError if the region of a prism cannot be filled however fine
[[nodiscard]] TriangleMesh facets_of(const PartBody& body, double tolerance, int round_corners = 3);

/// The same surface with all vertices of a cell of a grid at one of them, and what has lost its area left out: a picture's
/// worth of a mesh that has more facets than pixels.
/// @param cell  of the grid [m]; > 0
[[nodiscard]] TriangleMesh coarsened(const TriangleMesh& mesh, double cell);

}  // namespace glissade::parts
