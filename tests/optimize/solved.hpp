#pragma once

#include "glissade/optimize/optimize.hpp"

#include "support/catch.hpp"

namespace glissade::testing_problems {

/// The optimum of a problem that has to have one, which keeps every limit.
inline Optimum solved(const Problem& problem) {
  Optimum optimum = optimize(problem);
  INFO(optimum.report.brief());
  REQUIRE(optimum.report.status == OptimizeStatus::optimal);
  REQUIRE(optimum.centerline);
  for (const LimitCheck& check : optimum.report.checks) {
    CAPTURE(check.limit.key(), check.value, check.reached, check.where);
    CHECK(check.kept());
  }
  return optimum;
}

inline double drop_of(const Optimum& optimum) {
  return optimum.centerline->endpoints().drop;
}

}  // namespace glissade::testing_problems
