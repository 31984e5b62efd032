#pragma once

#include "glissade/pipeline/solve.hpp"

#include <optional>

namespace glissade::pipeline {

/// Rides a design's body from every gate of the design, in its own condition and in those beside it.
/// @return none for a design without gates
/// @throws InputError with the place in the design where the gates do not fit the track
[[nodiscard]] std::optional<GateTable> gate_table(const Design& design, const CenterlinePtr& centerline,
                                                  const Placement& placement);

}  // namespace glissade::pipeline
