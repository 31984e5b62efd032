#pragma once

#include "optimize/mesh/switches.hpp"

#include <vector>

namespace glissade::optimizer {

/// Knots that share out the error of a track found, from its own third differences, with two at each jump
/// and more of them where a jump could not be made out. By the length of the core, as it is.
/// @param pieces  of what lies between the switches; those of the switches come on top
[[nodiscard]] Vector refined_knots(const Transcription& track, const Vector& z,
                                   const std::vector<Switch>& switches, std::size_t pieces);

}  // namespace glissade::optimizer
