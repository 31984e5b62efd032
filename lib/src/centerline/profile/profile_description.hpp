#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/core/vec.hpp"

#include "centerline/profile/profile_pieces.hpp"
#include "centerline/profile/rounded_points.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace glissade::centerline {

/// Points put as few straights, arcs and clothoids, with jumps and kinks of curvature where the points show them.
struct Description {
  PiecewiseProfile profile;
  double mean_square = 0.0;  // of the points' distances [m^2]
  bool scattered = false;    // the points show noise
  double freedom = 0.0;      // numbers that the points had to yield; the places of breaks count twice
  double unlikely = 0.0;     // what pieces that drawings rarely have cost beside that, in numbers
};

/// @param points     in order, none repeated
/// @param reference  a smooth curve near them, from the first one on
/// @param places     to which they were rounded, where it shows
/// @return none where few pieces do not do: the points' curvature changes everywhere
[[nodiscard]] std::optional<Description> describe_in_pieces(const std::vector<Vec2>& points,
                                                            const ClothoidSpline& reference,
                                                            const std::optional<LastPlaces>& places);

/// What points that show noise leave open of the largest curvature, by all that describes them about as well.
/// Cost: mostly more than that of the description.
/// @return none where they show none, or nothing is as good
[[nodiscard]] std::optional<CurvatureRange> largest_curvature_of(const Description& description,
                                                                 const std::vector<Vec2>& points,
                                                                 const std::optional<LastPlaces>& places);

}  // namespace glissade::centerline
