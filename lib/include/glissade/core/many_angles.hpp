#pragma once

#include <span>

namespace glissade::math {

/// Sines and cosines of many angles [rad], several at a time.
///
/// Identity: the bits of sine_cosine() (`glissade/core/math.hpp`) of each angle, whatever stands beside it and on every
///   processor, at a quarter of its price, or half where the processor has no registers of four.
/// Source: SLEEF's functions of four and of two doubles, to the same bits (docs/decisions/0007).
/// @param sines, cosines  as many as angles
void sines_cosines(std::span<const double> angles, std::span<double> sines, std::span<double> cosines);

/// Exponentials of many values, several at a time; identity and source as above, of exp().
/// @param results  as many as values
void exponentials(std::span<const double> values, std::span<double> results);

}  // namespace glissade::math
