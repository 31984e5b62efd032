#pragma once

#include "glissade/pipeline/solve.hpp"
#include "glissade/trades/rules.hpp"

#include <vector>

namespace glissade {

/// Measures on a track, over every friction of its design, what rules may bound; what a design does not tell is
/// missing with the key that would tell it.
[[nodiscard]] Measurements rule_measurements(const Design& design, const Track& track);

/// Holds the rules of a design against its track.
[[nodiscard]] std::vector<Judgement> judge_rules(const Design& design, const Track& track);

}  // namespace glissade
