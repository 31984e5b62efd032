#pragma once

#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/core/vec.hpp"

#include "centerline/profile/profile_pieces.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// Straights that meet at an angle, and what the points leave open of the bends there.
struct MeetingStraights {
  PiecewiseProfile profile;
  CurvatureRange largest;
};

/// Points on few straights, at least 3 on each. Where two meet an arc leads over that passes no point of either: the
/// longest one between the points beside the kink, and next to none where a point lies in the kink itself.
/// @param tolerance  farthest that a point lies from its straight [m]
/// @return none unless there are two straights or more, and few
[[nodiscard]] std::optional<MeetingStraights> straights_through(const std::vector<Vec2>& points,
                                                                double tolerance);

/// The same of points that lie on their straights to rounding, at least kFewestToValidate.
[[nodiscard]] std::optional<MeetingStraights> straights_through(const std::vector<Vec2>& points);

}  // namespace glissade::centerline
