#pragma once

#include "glissade/pipeline/solve.hpp"
#include "glissade/trades/rules.hpp"

#include <string>
#include <vector>

namespace glissade::pipeline {

/// One way in which a chute is run: a friction of its range with a flow between trickle and surge.
struct ChuteCase {
  FrictionLevel friction = FrictionLevel::nominal;
  std::string flow;  ///< "trickle", "nominal", "surge"
  Motion motion;
};

/// Every friction of the design with every flow; a surge at the lowest density, at which it is deepest.
[[nodiscard]] std::vector<ChuteCase> chute_cases(const Design& design, const CenterlinePtr& centerline);

/// Measures on the track of a stream what the rules of chutes bound, over all of its cases.
void measure_chute(const Design& design, const Track& track, Measurements& measurements);

}  // namespace glissade::pipeline
