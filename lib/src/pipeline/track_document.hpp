#pragma once

#include "glissade/pipeline.hpp"

#include "report/serial/vocabulary.hpp"

namespace glissade::pipeline {

/// What is told of a track. Figures are its numbers, for a row of a table: warnings and verdicts of rules, of which there may be any
/// number, are not looked for. The friction at which the body stalls takes some fifty rides.
enum class Told { everything, figures_and_stall_margin, figures };

/// @return what track_json() prints, before it is text. Of figures alone `warnings`, `rules` and `cases` are empty; without a stall
///         margin its keys are null, and the nominal ride stands alone for itself, not among `rides`
[[nodiscard]] report::Json track_document(const Design& design, const Track& track,
                                          Told told = Told::everything);

}  // namespace glissade::pipeline
