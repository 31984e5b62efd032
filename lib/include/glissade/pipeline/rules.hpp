#pragma once

#include "glissade/pipeline/solve.hpp"
#include "glissade/trades/rules.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace glissade {

/// Measures on a track what rules may bound: the extremes over every friction of its design and every gate, in every condition, too.
/// What a design does not tell is missing with the key that would tell it; a ride that does not arrive lacks what only one that
/// does has, with its name and end. One that stalls has no exit speed and takes endless time.
[[nodiscard]] Measurements rule_measurements(const Design& design, const Track& track);

/// Holds the rules of a design against its track.
[[nodiscard]] std::vector<Judgement> judge_rules(const Design& design, const Track& track);

/// @return ">= 0.25 s [derived]": a bound for people, marked where nobody read it in its document, with digits_of() the judgement
[[nodiscard]] std::string marked_bound_text(const Judgement& judgement);
/// @return "derived, to be checked": how sure a bound is, for a column of its own
[[nodiscard]] std::string certainty_text(Certainty certainty);
/// @return "27.1 m/s^2 at 88 m (gate 49)", "-": what was measured, and where
[[nodiscard]] std::string measured_text(const Judgement& judgement);

/// A line a rule: id, verdict, value, lowest, highest, unit, margin, where_m, place, quantity, sentence, source, certainty,
/// needs_checking, reason; values as --json has them.
/// @throws FileError if the file cannot be written
void write_verdicts_csv(const std::filesystem::path& file, const std::vector<Judgement>& judgements);

}  // namespace glissade
