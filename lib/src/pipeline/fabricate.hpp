#pragma once

#include "glissade/pipeline.hpp"

#include <memory>
#include <string>
#include <vector>

namespace glissade::pipeline {

/// @return what the files of a design are named after
[[nodiscard]] std::string stem_of(const Design& design);

/// The parts of a design's track, made and proven.
/// @param frame  of the assembly: that of the mesh files
/// @throws InputError with the place in the design
[[nodiscard]] std::shared_ptr<const PlateBuild> fabricate(const Design& design, const Track& track,
                                                          const Placement& frame);

/// Every file that a workshop gets: a folder of parts, the assembly, drawings, a folder of nests, the tables.
/// @param split  says the stock sheets
[[nodiscard]] std::vector<PendingFile> workshop_files(const std::string& stem, const SplitOptions& split,
                                                      const std::shared_ptr<const PlateBuild>& build);

}  // namespace glissade::pipeline
