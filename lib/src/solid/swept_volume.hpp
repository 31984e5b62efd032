#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/section/cross_section.hpp"

#include "solid/level_curves.hpp"
#include "solid/widening.hpp"

namespace glissade::solid {

/// @param curves  the level curves of that centerline over the reach of the section
/// @return volume of the ideal solid to kSweepVolumeAccuracy, arcs round, trims cut [m^3]
[[nodiscard]] double swept_volume(const Centerline& centerline, const Widening& section,
                                  const LevelCurves& curves, const std::stop_token& stop = {});

}  // namespace glissade::solid
