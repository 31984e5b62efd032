#pragma once

#include <span>

namespace glissade::math {

/// Sines and cosines of many angles [rad], two at a time.
///
/// Identity: the bits of sine_cosine() (`glissade/core/math.hpp`) of each angle, whatever stands beside it and on every
///   processor, at less than half its price.
/// Source: SLEEF's function of two doubles in the instructions that every x86-64 has (docs/decisions/0007).
/// @param sines, cosines  as many as angles
void sines_cosines(std::span<const double> angles, std::span<double> sines, std::span<double> cosines);

}  // namespace glissade::math
