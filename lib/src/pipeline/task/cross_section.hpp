#pragma once

#include "glissade/design/design.hpp"

#include <string>

namespace glissade::pipeline {

/// @return e.g. "u-channel, width 400 mm, wall height 250 mm, thickness 4 mm"
[[nodiscard]] std::string section_in_words(const CrossSectionDesign& section);

/// @return whether the design has no cross_section and asks for no file that needs one: stations of the track
[[nodiscard]] bool tells_of_track_alone(const Design& design);

/// @throws InputError if the design has none and does not tell of the track alone: a build sweeps one along it
void require_cross_section(const Design& design);

}  // namespace glissade::pipeline
