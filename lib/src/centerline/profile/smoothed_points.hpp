#pragma once

#include "glissade/core/vec.hpp"

#include "centerline/profile/profile_cost.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// Points without the noise that they show.
struct SmoothedPoints {
  std::vector<Vec2> points;
  Cost cost;           // of distance, not over a length
  bool exact = false;  // the points as they were: what they show is no noise
};

/// Smooths points over a parameter by what their third divided differences cost (Whittaker's graduation), as much as
/// cross-validation asks.
/// @param parameters  strictly increasing, from 0 to 1
/// @param points      one for each; fewer than kFewestToValidate stay as they are
/// @return none where rounding stands in the way
[[nodiscard]] std::optional<SmoothedPoints> smoothed(const std::vector<double>& parameters,
                                                     const std::vector<Vec2>& points);

}  // namespace glissade::centerline
