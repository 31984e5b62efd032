#include "app/searched_track.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"

#include "app/interrupt.hpp"
#include "app/progress_line.hpp"

namespace glissade::app {

double shortest_length_of(const Design& design) {
  const bool is_given = design.track.free_finish == FinishKind::point && !is_drawn(design.centerline.kind);
  const Endpoints ends = endpoints_of(design);
  return is_given ? math::hypot(ends.run, ends.drop) : 0.0;
}

Track searched_track(const Design& design, const Verbosity& verbosity, double time_budget) {
  const Interrupt interrupt;
  ProgressLine progress(verbosity);
  return solve(design, interrupt.context(progress.callback(), time_budget));
}

void require_searched_through(const Design& design, const Track& track) {
  if (const auto problem = search_problem(design, track)) throw ConvergenceError(*problem);
}

}  // namespace glissade::app
