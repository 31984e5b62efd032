#include "optimize/box_search.hpp"

#include <cmath>
#include <exception>
#include <limits>

#include <nlopt.h>

namespace glissade::optimizer {
namespace {

constexpr int kMostEvaluations = 60;  // budget

struct Search {
  const std::function<double(const std::vector<double>&)>* value = nullptr;
  const std::function<bool()>* ends = nullptr;
  nlopt_opt engine = nullptr;
  std::optional<BoxMinimum> best;
  std::exception_ptr thrown;

  double see(const std::vector<double>& place) {
    const double found = (*value)(place);
    if (std::isfinite(found) && (!best || found < best->value)) best = BoxMinimum{place, found};
    return found;
  }
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

}  // namespace

std::optional<BoxMinimum> least_in_box(std::size_t variables,
                                       const std::function<double(const std::vector<double>&)>& value,
                                       const std::function<bool()>& ends) {
  Search search{&value, &ends, nullptr, {}, {}};
  const std::vector<double> middle(variables, 0.5);
  search.see(middle);
  for (std::size_t i = 0; i < variables && !ends(); ++i) {
    for (const double side : {0.0, 1.0}) {
      std::vector<double> place = middle;
      place[i] = side;
      search.see(place);
    }
  }
  if (!search.best || ends()) return search.best;
  search.engine = nlopt_create(NLOPT_LN_SBPLX, static_cast<unsigned>(variables));
  nlopt_set_min_objective(search.engine, evaluate, &search);
  nlopt_set_lower_bounds1(search.engine, 0.0);
  nlopt_set_upper_bounds1(search.engine, 1.0);
  nlopt_set_initial_step1(search.engine, 0.2);
  nlopt_set_xtol_abs1(search.engine, kBoxAccuracy);
  nlopt_set_maxeval(search.engine, kMostEvaluations);
  std::vector<double> place = search.best->at;
  double least = 0.0;
  nlopt_optimize(search.engine, place.data(), &least);
  nlopt_destroy(search.engine);
  if (search.thrown) std::rethrow_exception(search.thrown);
  return search.best;
}

}  // namespace glissade::optimizer
