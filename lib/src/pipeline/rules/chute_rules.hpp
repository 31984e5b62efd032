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
  std::optional<HoodPassage> hood = {};  ///< before it, of a design with a hood
};

/// Every friction of the design with every flow; a surge at the lowest density, at which it is deepest.
[[nodiscard]] std::vector<ChuteCase> chute_cases(const Design& design, const CenterlinePtr& centerline);

/// A ride at some flow and friction, for a reader who goes through them.
struct WhatIfRide {
  double mass_flow = 0.0;  ///< [kg/s]
  bool nominal = false;    ///< the design's own
  Motion motion;           ///< its body has the friction
};
/// Five frictions over the design's range, or 3 deg to either side where it has none (less where friction along the track would
/// leave what there is), each with seven flows from trickle to a third more than a surge: every flow of a friction, friction after
/// friction; at the nominal density.
[[nodiscard]] std::vector<WhatIfRide> what_if_rides(const Design& design, const CenterlinePtr& centerline);

/// Measures on the track of a stream what the rules of chutes bound, over all of its cases.
void measure_chute(const Design& design, const Track& track, Measurements& measurements);

}  // namespace glissade::pipeline
