#pragma once

#include "glissade/parts/arc_spline.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// Ends of units of about even length, each moved to where the track bends least nearby, and to a joint of its arcs if one
/// is near.
/// @param room  by which a joint may move [m]
/// @return arc lengths: 0, count - 1 joints, the length of the track
[[nodiscard]] std::vector<double> calm_joints(const ArcSpline& track, std::size_t count, double room);

/// @return the place near `about` where the track bends least, the nearest of equals
[[nodiscard]] double calm_place(const ArcSpline& track, double about, double room);

}  // namespace glissade::parts
