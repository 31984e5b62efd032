#pragma once

#include "glissade/core/arc_path.hpp"

#include <vector>

namespace glissade::core {

/// Lines and arcs one by one, for what is asked of paths made of them.

/// @param piece  not straight
/// @return the circle of an arc, without its angles
[[nodiscard]] Circle circle_of(const PathPiece& piece);

/// @param point  on the circle of an arc
[[nodiscard]] bool on_arc(const PathPiece& arc, Vec2 point);

/// @return whether a point lies beside a straight piece, or, of those on the circle of an arc, on the arc
[[nodiscard]] bool on_piece(const PathPiece& piece, Vec2 point);

/// @return the rectangle that holds nothing
[[nodiscard]] PlaneBox empty_box();
void widen(PlaneBox& box, Vec2 point);
/// @return the least rectangle that holds a piece
[[nodiscard]] PlaneBox bounds_of(const PathPiece& piece);
/// @return distance between two rectangles; 0 where they overlap
[[nodiscard]] double gap(const PlaneBox& a, const PlaneBox& b);

/// @return distance of a point from a piece; ends belong to it
[[nodiscard]] double distance_to_piece(const PathPiece& piece, Vec2 point);

/// @return where two pieces cross or touch, other than along each other
[[nodiscard]] std::vector<Vec2> meetings(const PathPiece& a, const PathPiece& b);

}  // namespace glissade::core
