#pragma once

#include "glissade/task/limit_catalogue.hpp"
#include "glissade/task/limits.hpp"

#include "clearance/region.hpp"

#include <vector>

namespace glissade::task {

/// One thing that limits ask to keep clear of, as distances are measured from it.
struct Obstacle {
  LimitName limit;
  double clearance = 0.0;  ///< asked for [m]; >= 0
  clearance::Region region;
};

/// @return half-planes, keep-outs, lines to stay above and below, in the order of the limits and in their frame: the plane of
///   the centerline, (run, drop)
[[nodiscard]] std::vector<Obstacle> obstacles_of(const Limits& limits);

}  // namespace glissade::task
