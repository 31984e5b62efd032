#pragma once

#include "glissade/pipeline/rules.hpp"

namespace glissade::pipeline {

/// Adds what rules of ski jumps ask: the letters of the certificate, the hill, and the gates at their worst. Of a track
/// ridden from gates the loads are those from them.
void measure_in_run(const Design& design, const Track& track, Measurements& measurements);

}  // namespace glissade::pipeline
