#pragma once

#include "glissade/parts/shop_part.hpp"

namespace glissade::parts {

/// @return how deep a point lies inside a body [m]; negative outside, no less than minus its distance
/// @param point  in the body's own frame
[[nodiscard]] double depth_inside(const PartBody& body, Vec3 point);

}  // namespace glissade::parts
