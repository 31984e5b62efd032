#pragma once

#include "glissade/study/summary.hpp"

#include <vector>

namespace glissade::study {

/// @param input     a value a row
/// @param quantity  likewise; not a number where a row has none, which is left out
/// @param independent  whether the input is independent of all others, without which there is no first-order index
/// @return correlation and index, without the places of the columns
[[nodiscard]] Influence influence_of(const std::vector<double>& input, const std::vector<double>& quantity,
                                     bool independent);

}  // namespace glissade::study
