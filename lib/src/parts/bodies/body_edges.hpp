#pragma once

#include "glissade/parts/shop_part.hpp"

#include <vector>

namespace glissade::parts {

/// What is looked at of a body to tell whether it reaches into another one.

/// @return points just inside a body along its edges, and some well inside it, in its own frame
/// @param inset  of the points from the faces [m]
[[nodiscard]] std::vector<Vec3> edge_points(const PartBody& body, double inset);

/// A straight edge, just inside its body.
struct EdgeLine {
  Vec3 from;
  Vec3 to;
};
/// @return of prisms and angles the straight edges: long ones may go through another part between any points that are looked
///         for; of others none, as their points are as close as they are thick, or prisms' edges find them
/// @param inset  of the edges from the faces [m]
[[nodiscard]] std::vector<EdgeLine> edge_lines(const PartBody& body, double inset);

}  // namespace glissade::parts
