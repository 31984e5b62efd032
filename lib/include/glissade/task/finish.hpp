#pragma once

#include "glissade/task/limits.hpp"

namespace glissade {

/// Where the track may end.
enum class FinishKind {
  point,          ///< at Endpoints
  vertical_line,  ///< at run = Endpoints::run, drop within Finish::free_range
  level           ///< at drop = Endpoints::drop, run within Finish::free_range
};

/// Where a track ends: in a point, or anywhere along a line.
struct Finish {
  FinishKind kind = FinishKind::point;
  Range free_range;  ///< of the coordinate that is free [m]; unlimited where left out
};

}  // namespace glissade
