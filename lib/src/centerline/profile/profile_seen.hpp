#pragma once

#include "glissade/centerline/fitted_profile.hpp"

#include "centerline/profile/profile_pieces.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// What points leave open of the largest curvature where they are exact, but fewer along some pieces than these have
/// unknowns: what else turns as far between the points beside them meets all points as well.
/// @param places  arc lengths of the points, ascending [m]
/// @param met     whether the profile meets them to rounding
/// @return none where every piece is determined
[[nodiscard]] std::optional<CurvatureRange> largest_curvature_unseen(const PiecewiseProfile& profile,
                                                                     const std::vector<double>& places,
                                                                     bool met);

}  // namespace glissade::centerline
