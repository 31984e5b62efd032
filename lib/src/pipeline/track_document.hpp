#pragma once

#include "glissade/pipeline.hpp"

#include "report/serial/vocabulary.hpp"

namespace glissade::pipeline {

/// Whether the friction at which the body stalls is looked for, which takes some fifty rides.
enum class StallMargin { yes, no };

/// @return what track_json() prints, before it is text; without a stall margin its keys are null, and the nominal ride
///         stands alone for itself, not among `rides`
[[nodiscard]] report::Json track_document(const Design& design, const Track& track,
                                          StallMargin margin = StallMargin::yes);

}  // namespace glissade::pipeline
