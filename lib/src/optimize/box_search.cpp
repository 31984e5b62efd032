#include "optimize/box_search.hpp"

#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <nlopt.h>

namespace glissade::optimizer {
namespace {

struct Search {
  const std::function<double(const std::vector<double>&)>* value = nullptr;
  const std::function<bool()>* ends = nullptr;
  nlopt_opt engine = nullptr;
  std::optional<BoxMinimum> best;
  std::exception_ptr thrown;
  std::map<std::vector<double>, double> seen;
  bool met_nothing = false;  ///< at some place there was no value

  double see(const std::vector<double>& place) {
    // A search comes back to corners of the box.
    const auto known = seen.find(place);
    if (known != seen.end()) return known->second;
    const double found = (*value)(place);
    seen.emplace(place, found);
    if (std::isfinite(found) && (!best || found < best->value)) best = BoxMinimum{place, found};
    met_nothing = met_nothing || !std::isfinite(found);
    return found;
  }
  /// From the best so far. @return whether the engine came to its end
  bool go_on(std::size_t variables, nlopt_algorithm method);
};

/// NLopt is told a large value where there is none: it compares.
double evaluate(unsigned variables, const double* place, double* /*gradient*/, void* data) {
  constexpr double kNone = 1e30;  // taste: above any value
  auto& search = *static_cast<Search*>(data);
  try {
    if ((*search.ends)()) {
      nlopt_force_stop(search.engine);
      return kNone;
    }
    const double found = search.see({place, place + variables});
    return std::isfinite(found) ? found : kNone;
  } catch (...) {
    // No exception may pass through C.
    search.thrown = std::current_exception();
    nlopt_force_stop(search.engine);
    return kNone;
  }
}

bool Search::go_on(std::size_t variables, nlopt_algorithm method) {
  met_nothing = false;
  engine = nlopt_create(method, static_cast<unsigned>(variables));
  nlopt_set_min_objective(engine, evaluate, this);
  nlopt_set_lower_bounds1(engine, 0.0);
  nlopt_set_upper_bounds1(engine, 1.0);
  nlopt_set_initial_step1(engine, 0.2);
  nlopt_set_xtol_abs1(engine, kBoxAccuracy);
  nlopt_set_maxeval(engine, kMostBoxValues);
  std::vector<double> place = best->at;
  double least = 0.0;
  const nlopt_result result = nlopt_optimize(engine, place.data(), &least);
  nlopt_destroy(engine);
  if (thrown) std::rethrow_exception(thrown);
  // Rounding ends a search that has nothing left to win.
  return result == NLOPT_XTOL_REACHED || result == NLOPT_ROUNDOFF_LIMITED;
}

/// @return the best that was found, marked so
std::optional<BoxMinimum> marked(std::optional<BoxMinimum> best, bool to_the_end) {
  if (best) best->to_the_end = to_the_end;
  return best;
}

}  // namespace

std::optional<BoxMinimum> least_in_box(std::size_t variables,
                                       const std::function<double(const std::vector<double>&)>& value,
                                       const std::function<bool()>& ends) {
  Search search;
  search.value = &value;
  search.ends = &ends;
  const std::vector<double> middle(variables, 0.5);
  bool everywhere = std::isfinite(search.see(middle));
  for (std::size_t i = 0; i < variables && !ends(); ++i) {
    for (const double side : {0.0, 1.0}) {
      std::vector<double> place = middle;
      place[i] = side;
      everywhere = std::isfinite(search.see(place)) && everywhere;
    }
  }
  if (!search.best || ends()) return marked(search.best, false);
  // A quadratic model takes a third of the evaluations; it has to have a value wherever it looks.
  if (everywhere && variables > 1) {
    const bool ended = search.go_on(variables, NLOPT_LN_BOBYQA);
    if (!search.met_nothing) return marked(search.best, ended);
  }
  const bool ended = search.go_on(variables, NLOPT_LN_SBPLX);
  return marked(search.best, ended);
}

}  // namespace glissade::optimizer
