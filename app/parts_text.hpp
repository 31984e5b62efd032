#pragma once

#include "glissade/parts/plates.hpp"

#include <string>

namespace glissade::app {

/// What a workshop makes, for the summary of a build: arcs, parts, ride as built, checks that are not passed.
[[nodiscard]] std::string parts_lines(const PlateBuild& build);

}  // namespace glissade::app
