#pragma once

#include "glissade/pipeline.hpp"

#include <memory>
#include <stop_token>
#include <vector>

namespace glissade::pipeline {

/// Tells every part the names of its own files, as the design asks for them.
void name_part_files(const Design& design, Workshop& workshop);

/// Lays the parts on the design's sheets, where it asks for nests.
/// @throws InputError at "split.sheet" with all parts that fit no sheet
void lay_on_sheets(const Design& design, WorkshopBuild& build);

/// Counts the pages of 1:1 templates, where the design asks for them.
void count_templates(const Design& design, WorkshopBuild& build);

/// Every file that a workshop gets and the design asks for: a folder of parts, the assembly, drawings, templates, a folder
/// of nests, the tables.
/// @throws Interrupted if `stop` asks for it while the mesh of a part is rounded
[[nodiscard]] std::vector<PendingFile> workshop_files(const Design& design,
                                                      const std::shared_ptr<const WorkshopBuild>& build,
                                                      const std::stop_token& stop);

}  // namespace glissade::pipeline
