#pragma once

#include "glissade/core/vec.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// The last decimal places of points [m]; 0 where a coordinate was not rounded.
struct LastPlaces {
  double x = 0.0;
  double y = 0.0;
};

/// @return the decimal places to which points were rounded, where the points scatter by as much: what rounding leaves
///         repeats itself along a straight and is no noise that a fit could tell from shape. None where points have
///         more digits, lie exactly where their digits say, or scatter by much more.
[[nodiscard]] std::optional<LastPlaces> last_places(const std::vector<Vec2>& points);

/// @return the points, each moved inside its last places by what passes for chance; the same for the same points.
///         What rounding leaves is noise then, of twice its square.
[[nodiscard]] std::vector<Vec2> dithered(std::vector<Vec2> points, const LastPlaces& places);

/// @return mean square of what rounding leaves across the points' line [m^2]
[[nodiscard]] double noise_of_rounding(const std::vector<Vec2>& points, const LastPlaces& places);

/// What neighbours do not foretell of each other [m]: as large as the noise of points that have some, next to nothing of exact
/// points that are not few for their bends.
struct NeighbourScatter {
  double all = 0.0;      // in the root of the mean square, places where curvature breaks among them
  double quarter = 0.0;  // by the quarter that is foretold best
};

/// @return none of fewer than 20 points
[[nodiscard]] std::optional<NeighbourScatter> scatter_beside_neighbours(const std::vector<Vec2>& points);

}  // namespace glissade::centerline
