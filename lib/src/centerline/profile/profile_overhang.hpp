#pragma once

#include "glissade/centerline/clothoid_spline.hpp"

#include "centerline/profile/profile_fit.hpp"

namespace glissade::centerline {

/// The farthest that a curve turns beyond the vertical, to either side [rad]; below 0 where it does not.
[[nodiscard]] double beyond_vertical(const ClothoidSpline& curve);

/// The curve with a vertical straight in place of what overhangs, moved so that the rest stays where most of it was.
[[nodiscard]] FittedCurve not_overhanging(FittedCurve found);

}  // namespace glissade::centerline
