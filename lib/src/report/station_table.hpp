#pragma once

#include "glissade/motion/motion.hpp"

#include "report/serial/vocabulary.hpp"

#include <vector>

namespace glissade::report {

/// Places at the finest spacing that a reader of the table of stations may choose; all others take every so many of them.
struct StationGrid {
  double spacing = 0.0;        ///< a power of ten [m]; 200 to 2000 of them in the ride
  std::vector<double> places;  ///< multiples of it from 0, and the end of the ride [m]
};

[[nodiscard]] StationGrid station_grid(const Motion& motion);

/// The track at each place of a grid, columns of numbers without rounding, NaN where one is unbounded.
/// @param start_height  of the site [m]
[[nodiscard]] Json track_table(const Motion& motion, const StationGrid& grid, double start_height);

/// A ride there, NaN from where it ends.
[[nodiscard]] Json ride_table(const Motion& motion, const StationGrid& grid);

}  // namespace glissade::report
