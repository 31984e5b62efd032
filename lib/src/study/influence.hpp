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

/// Which inputs are no longer independent of another among the rows that are used, their values being independent over all
/// rows: where the share of rows that are used is no product of a factor of one input and a factor of the other, by a test of
/// chi-squared over classes of both. Pair by pair: what three inputs do only together is not seen.
/// @param inputs  a value a row, for each input; words as numbers
/// @param used    a flag a row
[[nodiscard]] std::vector<bool> dependent_inputs(const std::vector<std::vector<double>>& inputs,
                                                 const std::vector<bool>& used);

}  // namespace glissade::study
