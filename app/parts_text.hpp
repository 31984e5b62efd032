#pragma once

#include "glissade/parts/workshop_build.hpp"

#include <string>

namespace glissade::app {

/// What a workshop makes, for the summary of a build: arcs, parts, ride as built, checks that are not passed.
[[nodiscard]] std::string parts_lines(const WorkshopBuild& build);

}  // namespace glissade::app
