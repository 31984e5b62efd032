#pragma once

#include "glissade/drawing/sheet.hpp"
#include "glissade/pipeline/solve.hpp"

namespace glissade::pipeline {

/// One page (A4, upright) on a chute for the file: side view with the stream in it, from feed to belt; depth, speed and wear
/// along the track as bands over friction; what it is made for, what the stream does at each friction, and every verdict.
/// @param design  with a stream, solved
[[nodiscard]] Sheet chute_data_sheet(const Design& design, const Track& track);

}  // namespace glissade::pipeline
