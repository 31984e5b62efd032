#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/vec.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// The one clothoid spline of continuous curvature that has its joints in points, one clothoid from each to the next
/// (Bertolazzi and Frego, J. Comput. Appl. Math. 341 (2018) 99, by their angles as unknowns), where most of these joints
/// turn out to be none: the curvature goes on as it was. No chance of points does so, but stations of a track that was
/// drawn or found as clothoids do, as long as its joints are among them.
/// @param points  in order, from the origin
/// @param angles  slope angles there, nearly [rad]
/// @return none where joints are what they seem, or angles turn by too much from point to point
[[nodiscard]] std::optional<ClothoidSpline> clothoids_between(const std::vector<Vec2>& points,
                                                              std::vector<double> angles);

}  // namespace glissade::centerline
