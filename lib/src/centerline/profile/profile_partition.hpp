#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/vec.hpp"

#include "centerline/profile/profile_pieces.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// Points and where they lie beside a curve that leads along them.
struct PlacedPoints {
  std::vector<double> places;      // arc length of the nearest place of the curve
  std::vector<double> deviations;  // distance from there, positive below the curve
};

/// @param reference  a curve near the points; it may pass over what the points show of jumps in curvature
/// @return an estimate of the scatter of the points across the curve [m] that bends and jumps of curvature hardly
///         touch: the lower quartile over short windows of what a quintic leaves
[[nodiscard]] double scatter_of(const ClothoidSpline& reference, const PlacedPoints& points);

/// Cuts points into stretches of constant or evenly changing curvature, with breaks between them: the cut that
/// pays best when `scatter` is the points' noise and every number of the description costs as in the Bayesian
/// information criterion. Neighbouring stretches need not fit together: a first guess for PieceFit.
/// Cost: quadratic in the number of points.
/// @return none if more than kMostProfilePieces were needed
[[nodiscard]] std::optional<PiecewiseProfile> partition(const ClothoidSpline& reference,
                                                        const PlacedPoints& points, double scatter);

inline constexpr std::size_t kMostProfilePieces = 60;

}  // namespace glissade::centerline
