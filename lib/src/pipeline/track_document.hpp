#pragma once

#include "glissade/pipeline.hpp"

#include "report/serial/vocabulary.hpp"

namespace glissade::pipeline {

/// @return what track_json() prints, before it is text
[[nodiscard]] report::Json track_document(const Design& design, const Track& track);

}  // namespace glissade::pipeline
