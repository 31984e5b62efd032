#pragma once

#include "glissade/core/units.hpp"

namespace glissade {

/// Sizes of an in-run as rules and certificates suggest them for a hill size: a place to start from.
struct InRunSizes {
  double hill_size = 0.0;           ///< HS [m]
  double construction_point = 0.0;  ///< w [m]
  double design_speed = 0.0;        ///< v0 [m/s]
  Angle gamma;
  Angle alpha;
  double r1 = 0.0;            ///< [m]; 0.14 v0^2, rounded up to half a metre
  double t = 0.0;             ///< [m]; 0.25 v0, rounded up to 5 cm
  double e1 = 0.0;            ///< to the beginning of the table [m]
  double es = 0.0;            ///< [m]
  double table_height = 0.0;  ///< s [m]; 0.025 w, of flying hills 3.2 m
  int gates = 0;              ///< so many that one is at most 0.40 m above the next
};

/// The conditions that sizes are for: at `kSlowFriction` the highest gate gives the design speed.
inline constexpr double kSlowFriction = 0.06;
inline constexpr double kInRunDrag = 0.0013;  ///< [1/m]

/// @param hill_size  HS [m]; kSmallestHill to kLargestHill
/// @return sizes that keep the rules of the set fis-in-run
/// @throws InputError if the hill size is out of its range
[[nodiscard]] InRunSizes suggested_in_run(double hill_size);

inline constexpr double kSmallestHill = 10.0;  ///< [m]
inline constexpr double kLargestHill = 260.0;  ///< [m]

}  // namespace glissade
