#pragma once

#include "glissade/core/workshop_format.hpp"
#include "glissade/parts/workshop_build.hpp"

#include <string>

namespace glissade::app {

/// What a workshop makes, for the summary of a build: arcs, parts, sheets of stock, pages of templates, ride as built, checks that
/// are not passed.
/// @param paper  that templates are made for
[[nodiscard]] std::string parts_lines(const WorkshopBuild& build, TemplatePaper paper);

}  // namespace glissade::app
