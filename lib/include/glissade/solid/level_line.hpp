#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/vec.hpp"

#include <vector>

namespace glissade {

/// The curve that one height of a section runs along, as a line to draw: the offset curve of the centerline,
/// cut at the end faces and where its branches cross (docs/solid.md, trims).
///
/// Frame: (x, z), run and height from the start [m].
/// @param height     above the floor; negative below it [m]; finite
/// @param tolerance  greatest distance of the line from the curve [m]; finite, at least 1e-12 of the track's length
/// @throws InputError if height or tolerance is outside its stated range
/// @return from the start face to the finish face; where nothing of that height leads through, the offset
///         curve uncut
[[nodiscard]] std::vector<Vec2> level_line(const Centerline& centerline, double height, double tolerance);

/// @throws InputError as level_line()
/// The same curve uncut: through the end planes, and folded over beyond a centre of curvature.
[[nodiscard]] std::vector<Vec2> offset_line(const Centerline& centerline, double height, double tolerance);

}  // namespace glissade
