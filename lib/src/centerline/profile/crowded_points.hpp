#pragma once

#include "glissade/core/vec.hpp"

#include <cstddef>
#include <vector>

namespace glissade::centerline {

/// Whether steps from point to point run back: a crowd's do, those along a wave, however steep, do not.
[[nodiscard]] bool lose_order(const std::vector<Vec2>& points);

/// How many points from one on lie so close together that the way from the first to the last of them is lost in noise: the
/// mean of them is within this reach of that of as many behind them.
/// @return 1 where they are no crowd
[[nodiscard]] std::size_t lost_from(const std::vector<Vec2>& points, std::size_t first, double reach);

/// The points with those as one that noise hides the order of: at the first end, or all along.
[[nodiscard]] std::vector<Vec2> with_order_told(const std::vector<Vec2>& points, double reach,
                                                bool all_along);

/// The points with those at both ends as one.
[[nodiscard]] std::vector<Vec2> with_ends_told(const std::vector<Vec2>& points, double reach);

}  // namespace glissade::centerline
