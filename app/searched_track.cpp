#include "app/searched_track.hpp"

#include "glissade/core/error.hpp"

#include "app/interrupt.hpp"
#include "app/progress_line.hpp"

namespace glissade::app {

Track searched_track(const Design& design, const Verbosity& verbosity, double time_budget) {
  const Interrupt interrupt;
  ProgressLine progress(verbosity);
  return solve(design, interrupt.context(progress.callback(), time_budget));
}

void require_searched_through(const Design& design, const Track& track) {
  if (const auto problem = search_problem(design, track)) throw ConvergenceError(*problem);
}

}  // namespace glissade::app
