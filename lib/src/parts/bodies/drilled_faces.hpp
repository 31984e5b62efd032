#pragma once

#include "parts/bodies/bores.hpp"
#include "parts/bodies/mesh_chords.hpp"

#include <vector>

namespace glissade::parts {

/// Holes through plates that are flat between two chords.

/// @return the holes whose middles lie between two places along a path, and between two across
/// @param bores  of the holes, one each
[[nodiscard]] std::vector<const Bore*> between(const std::vector<Circle>& holes,
                                               const std::vector<Bore>& bores, double from, double to,
                                               Vec2 rows = {-1e300, 1e300});

/// @return whether a hole between two places along a path lies across a line at a place across
[[nodiscard]] bool is_crossed(const std::vector<Circle>& holes, double from, double to, double across);

/// Adds both faces of a plate between two chords with the holes between them, and the walls of the holes.
/// @param face,back  corners, counter-clockwise seen from outside, the first, second and last one not in one line; holes go in at
///                   the face
void add_drilled(TriangleMesh& mesh, const std::vector<Index>& face, const std::vector<Index>& back,
                 const std::vector<const Bore*>& bores, const Fineness& fineness);

}  // namespace glissade::parts
