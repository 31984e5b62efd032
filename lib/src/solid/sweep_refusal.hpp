#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/core/error.hpp"
#include "glissade/section/cross_section.hpp"

#include "solid/level_curves.hpp"

namespace glissade::solid {

/// Tells why a section cannot follow a track, where, and how far it may reach.
/// @param height  of a level that meets an obstacle
[[nodiscard]] Issue section_issue(const Centerline& centerline, const CrossSection& section,
                                  const LevelCurves& curves, double height);

/// Tells that the width changes where the section folds over: the two branches that meet there are not of one width.
/// @param from,to  arc lengths between which it folds over [m]
/// @throws InputError always
[[noreturn]] void refuse_widening(double from, double to);

/// Tells that no mesh was found that departs so little from a solid whose width changes.
/// @throws InputError always
[[noreturn]] void refuse_fine_widening(double tolerance);

}  // namespace glissade::solid
