#pragma once

#include "glissade/core/arc_path.hpp"

namespace glissade::core {

/// @return distance of a point from a piece of a path; ends belong to it
[[nodiscard]] double distance_to_piece(const PathPiece& piece, Vec2 point);

}  // namespace glissade::core
