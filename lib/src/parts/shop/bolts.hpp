#pragma once

#include "glissade/core/arc_path.hpp"
#include "glissade/parts/plates.hpp"

#include <vector>

namespace glissade::parts {

/// A metric bolt with nut and two washers.
struct Bolt {
  int size = 0;       ///< nominal diameter [mm]
  double fine = 0.0;  ///< clearance holes, ISO 273 [m]
  double medium = 0.0;
  double coarse = 0.0;
  double nut_height = 0.0;           ///< ISO 4032 [m]
  double washer_height = 0.0;        ///< ISO 7089 [m]
  double large_washer_height = 0.0;  ///< ISO 7093-1 [m]
  double washer = 0.0;               ///< outer diameter, ISO 7089 [m]
  double large_washer = 0.0;         ///< outer diameter, ISO 7093-1 [m]
  double head_height = 0.0;          ///< k of a countersunk one, ISO 10642 [m]; 0: it has none
};
/// @return whether its holes are known, as those of bolt_sizes() are
[[nodiscard]] bool is_bolt_size(int size);
/// @throws InputError if the size is unknown
[[nodiscard]] const Bolt& bolt_of(int size);

/// @return what reaches through a grip, two washers, the nut and two threads [m]
[[nodiscard]] double least_bolt_length(const Bolt& bolt, double grip);
/// @return the least nominal length of ISO 888 (ISO 4017, ISO 10642) that does [m]
[[nodiscard]] double bolt_length(const Bolt& bolt, double grip);

/// Centres along a line: one at each end, the others evenly between, no farther apart than the pitch.
[[nodiscard]] std::vector<Vec2> evenly(Vec2 from, Vec2 to, double pitch);

}  // namespace glissade::parts
