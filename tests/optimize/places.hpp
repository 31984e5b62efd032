#pragma once

#include "glissade/task/problem.hpp"

#include <vector>

namespace testing {

/// The same problem with its places counted from the finish.
/// @param finish  where the finish lies, run and drop from the start
inline glissade::Problem counted_from_finish(glissade::Problem problem, glissade::Vec2 finish) {
  glissade::Limits& limits = problem.limits;
  const auto shift = [&](std::vector<glissade::Vec2>& points) {
    for (glissade::Vec2& point : points) point = point - finish;
  };
  for (glissade::HalfPlane& plane : limits.half_planes) plane.point = plane.point - finish;
  for (glissade::KeepOut& area : limits.keep_outs) shift(area.outline);
  for (glissade::Profile& profile : limits.stay_above) shift(profile.line);
  for (glissade::Profile& profile : limits.stay_below) shift(profile.line);
  shift(limits.waypoints);
  problem.places_from = glissade::PlacesFrom::finish;
  return problem;
}

}  // namespace testing
