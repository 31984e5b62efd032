#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/core/vec.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// A curve beside points.
struct FittedCurve {
  ClothoidSpline curve;
  Vec2 start;               // where it begins, in the frame of the points
  double between = 0.0;     // FittedProfile::between_points()
  double last_place = 0.0;  // to which the points were rounded; 0 where they do not show it
  std::optional<CurvatureRange> largest_curvature;
};

/// Fits a clothoid spline to points in order along it: few pieces with breaks of curvature between them where
/// that describes the points best, or else a smooth one from the first point on.
/// @param points  at least 3, without repeated neighbours, in an order that a track can follow
/// @throws InfeasibleError if fit.max_deviation cannot be met
[[nodiscard]] FittedCurve fit_clothoid_spline(const std::vector<Vec2>& points, const ProfileFit& fit);

/// @return for each point the nearest place on the curve, searched from where the points' order suggests
[[nodiscard]] std::vector<PointDeviation> deviations_from(const ClothoidSpline& curve,
                                                          const std::vector<Vec2>& points);

}  // namespace glissade::centerline
