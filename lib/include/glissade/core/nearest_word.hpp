#pragma once

#include <string_view>
#include <vector>

namespace glissade {

/// The word that was meant where another was written.
///
/// Letters inserted, left out, replaced or swapped with a neighbour count one each, case and the choice of
/// separator (- _ . blank) nothing; a word broken off early is a slip too.
/// @return the candidate at the least distance, of which at most a third of the letters of `word` (at least
///         one) are wrong; else the only one that has it as a part between separators; empty if none is near
[[nodiscard]] std::string_view nearest_word(std::string_view word,
                                            const std::vector<std::string_view>& candidates);

}  // namespace glissade
