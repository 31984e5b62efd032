#pragma once

#include "glissade/design/design.hpp"

#include <string>

namespace glissade::pipeline {

/// @return e.g. "u-channel, width 400 mm, wall height 250 mm, thickness 4 mm"
[[nodiscard]] std::string section_in_words(const CrossSectionDesign& section);

/// @throws InputError if the design has none: a build sweeps one along the centerline
void require_cross_section(const Design& design);

}  // namespace glissade::pipeline
