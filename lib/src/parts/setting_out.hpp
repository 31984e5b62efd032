#pragma once

#include "glissade/parts/arc_spline.hpp"
#include "glissade/parts/shop_part.hpp"
#include "glissade/route/placement.hpp"

#include <vector>

namespace glissade::parts {

/// Where a track is measured on site: its ends, joints and round distances.
/// @param joints  arc lengths of units' ends, both ends of the track among them [m]
[[nodiscard]] std::vector<SettingOutPoint> setting_out(const ArcSpline& track,
                                                       const std::vector<double>& joints,
                                                       const Placement& placement);

}  // namespace glissade::parts
