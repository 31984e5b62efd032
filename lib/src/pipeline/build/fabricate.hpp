#pragma once

#include "glissade/pipeline.hpp"

#include <memory>
#include <stop_token>
#include <string>

namespace glissade::pipeline {

/// @return what the files of a design are named after
[[nodiscard]] std::string stem_of(const Design& design);

/// The parts of a design's track, made and proven.
/// @param frame  of the assembly: that of the mesh files
/// @throws InputError with the place in the design
/// @throws Interrupted if `stop` asks for it while pieces are printed
[[nodiscard]] std::shared_ptr<const WorkshopBuild> fabricate(const Design& design, const Track& track,
                                                             const Placement& frame,
                                                             const std::stop_token& stop);

}  // namespace glissade::pipeline
