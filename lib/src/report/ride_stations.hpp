#pragma once

#include "glissade/motion/motion.hpp"

#include <vector>

namespace glissade::report {

/// @return arc lengths over the ride, ascending from 0 to its end: closer together near the start, where a
///         body at rest and an unbounded curvature change most, and one at every break of curvature
[[nodiscard]] std::vector<double> ride_stations(const Motion& motion);

/// The same over the whole track, whether or not the body came to its end.
[[nodiscard]] std::vector<double> track_stations(const Centerline& centerline);

}  // namespace glissade::report
