#pragma once

#include "glissade/pipeline/rules.hpp"

namespace glissade::pipeline {

/// Adds what rules of ski jumps ask: the letters of the certificate, the hill, and the gates in every condition.
/// @param measurements  which hold what every ride has: of the loads is what they are above the weight on the table
void measure_in_run(const Design& design, const Track& track, Measurements& measurements);

}  // namespace glissade::pipeline
