#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/section/cross_section.hpp"

#include "solid/level_curves.hpp"

namespace glissade::solid {

/// Tells why a section cannot follow a track, where, and how far it may reach.
/// @param height  of a level that meets an obstacle
/// @throws InputError always
[[noreturn]] void refuse_section(const Centerline& centerline, const CrossSection& section,
                                 const LevelCurves& curves, double height);

}  // namespace glissade::solid
