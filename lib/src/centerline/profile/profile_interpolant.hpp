#pragma once

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/vec.hpp"

#include "centerline/profile/profile_cost.hpp"

#include <optional>
#include <vector>

namespace glissade::centerline {

/// A curve through all points, or through what is left of them without their noise.
struct FollowedProfile {
  ClothoidSpline curve;
  Vec2 start;                              // where it begins, in the frame of the points
  Cost cost;                               // over the curve's length
  bool exact = false;                      // through the points as they are
  bool recovered = false;                  // the points are stations of this very curve
  double between = 0.0;                    // how far the points leave open where it passes between them [m]
  std::optional<double> missed_by_half{};  // by a spline through every second point, of the others [m]
};

/// Leads a curve through points by a spline of fifth degree, over x or over arc length, whichever leaves less open
/// between them, and puts clothoids in its place. However many waves: nothing is searched that could end in another
/// valley. Where the points are stations of a spline of clothoids, that is what comes back.
/// @param points  in order, at least 8
/// @return none where points are too uneven for it
[[nodiscard]] std::optional<FollowedProfile> follow_points(const std::vector<Vec2>& points);

/// Clothoids from knot to knot stand for a curve whose curvature is smooth: where knots are few for its waves their chords
/// pass over every peak of it. @return that curve, by more clothoids; the same one where knots are many
[[nodiscard]] ClothoidSpline without_chords(const ClothoidSpline& curve);

}  // namespace glissade::centerline
