#pragma once

#include "glissade/optimize/optimize.hpp"

namespace glissade::optimizer {

/// Marks a search that found a track and was asked to end: in whatever step of it the request came, it is met, and told.
inline void tell_stopped(OptimizeReport& report) {
  report.ended_early = true;
  report.interrupted = true;
  if (report.status != OptimizeStatus::optimal) return;
  report.status = OptimizeStatus::feasible_not_converged;
  report.message = "stopped: the best track so far";
}

}  // namespace glissade::optimizer
