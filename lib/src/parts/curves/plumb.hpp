#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/parts/arc_spline.hpp"

#include <optional>

namespace glissade::parts {

/// @param line   open, in the frame (x, height); its arcs turn by half a turn at most
/// @param point  in the same frame
/// @return height of the highest point of the line plumb below a point; none where none of it is
/// Accuracy: kPlumbAccuracy, where the line is no steeper than 89 deg.
[[nodiscard]] std::optional<double> level_below(const ArcPath& line, Vec2 point);

/// Stated bound of the error of level_below() [m], of lines up to 100 m.
inline constexpr double kPlumbAccuracy = 1e-10;

/// @param x      horizontal distance from the start [m]
/// @param about  arc length [m]
/// @return the place of a track at a distance, where it runs forwards; of several the nearest to `about`; none where it does not come
///         to it
[[nodiscard]] std::optional<double> place_at_run(const ArcSpline& track, double x, double about);

}  // namespace glissade::parts
