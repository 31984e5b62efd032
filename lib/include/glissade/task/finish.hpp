#pragma once

#include "glissade/task/limits.hpp"

namespace glissade {

/// Where the track may end, seen from its start; a start that is free, below a finish that is given, asks the same.
enum class FinishKind {
  point,          ///< at Endpoints
  vertical_line,  ///< at run = Endpoints::run, drop within Finish::free_range
  level,          ///< at drop = Endpoints::drop, run within Finish::free_range
  anywhere        ///< run within Finish::free_range, drop within Finish::free_drop
};

/// @return whether the run of the finish is that of Endpoints
[[nodiscard]] constexpr bool fixes_run(FinishKind kind) {
  return kind == FinishKind::point || kind == FinishKind::vertical_line;
}
/// @return whether the drop of the finish is that of Endpoints
[[nodiscard]] constexpr bool fixes_drop(FinishKind kind) {
  return kind == FinishKind::point || kind == FinishKind::level;
}

/// Where a track ends: in a point, or anywhere along a line.
struct Finish {
  FinishKind kind = FinishKind::point;
  Range free_range =
      {};  ///< of the coordinate that is free [m], of the run where both are; unlimited where left out
  Range free_drop = {};  ///< of the drop where both are free [m]; unlimited where left out
};

}  // namespace glissade
