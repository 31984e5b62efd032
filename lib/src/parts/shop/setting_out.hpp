#pragma once

#include "glissade/parts/arc_spline.hpp"
#include "glissade/parts/shop_part.hpp"
#include "glissade/route/placement.hpp"

#include "parts/curves/offset_line.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// Where a track is measured on site: its ends, joints and round distances.
/// @param joints  arc lengths of units' ends, both ends of the track among them [m]
[[nodiscard]] std::vector<SettingOutPoint> setting_out(const ArcSpline& track,
                                                       const std::vector<double>& joints,
                                                       const Placement& placement);

/// @param joints  as above
/// @return the segment that a place lies in, of two that meet there the one that begins: its ends are those of the chord whose
///         ordinate is told
[[nodiscard]] Span segment_at(const std::vector<double>& joints, double s);

/// One more place.
/// @param chord  whose ordinate is told
[[nodiscard]] SettingOutPoint setting_out_point(const ArcSpline& track, const Span& chord,
                                                const Placement& placement, std::string what, double s);

/// What stands below the track: its row is the place of the track plumb above its middle, and its name tells where it stands. What
/// holds up the end of a slope may stand beyond it, with no track plumb above: its row is its own foot
/// (SettingOutPoint::beyond_track).
struct StandingBelow {
  std::string what;   ///< "support 3"
  double x = 0.0;     ///< of its middle [m]
  double foot = 0.0;  ///< height of its foot [m]
  double at = 0.0;    ///< the place that it holds up
};
/// @param joints  as of segment_at()
/// @return its row, called "support 3: middle x 2410.5, foot z -900" in millimetres
[[nodiscard]] SettingOutPoint setting_out_point(const ArcSpline& track, const std::vector<double>& joints,
                                                const Placement& placement, const StandingBelow& standing);

/// Puts rows in the order of their arc lengths.
void in_order(std::vector<SettingOutPoint>& rows);

}  // namespace glissade::parts
