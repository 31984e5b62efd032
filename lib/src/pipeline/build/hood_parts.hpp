#pragma once

#include "glissade/parts/plates.hpp"
#include "glissade/pipeline/solve.hpp"

namespace glissade::pipeline {

/// Adds the hood of a design to a build of its track, as plates of the same options: made as the valley that it is upside down, of
/// the section at the start of the track, turned over and put where it hangs. Supports, lifting, inspection and cover are those
/// of the track alone; its liner is of one kind.
/// @param frame  of the parts
/// @throws InputError as make_plates(), and where parts of hood and track would meet
void add_hood_parts(const Design& design, const Track& track, const Placement& frame,
                    const PlateOptions& options, WorkshopBuild& build);

}  // namespace glissade::pipeline
