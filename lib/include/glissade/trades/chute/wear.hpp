#pragma once

#include "glissade/trades/chute/stream.hpp"

#include <vector>

namespace glissade {

/// A stretch of a track.
struct WearStretch {
  double from = 0.0;  ///< arc length [m]
  double to = 0.0;
};

/// Where a stream wears its chute most, over several rides (docs/chutes.md, wear).
struct WearFacts {
  ValueAt floor;            ///< greatest wear factor W_c of the floor [W/m^2]
  std::size_t ride = 0;     ///< the one that it is of
  double friction = 0.0;    ///< mu there
  ValueAt wall;             ///< greatest of the side walls, below the surface [W/m^2]
  double mean_floor = 0.0;  ///< mean W_c of that ride along the track [W/m^2]
  /// Where the floor wears at least half as fast as at its peak on any of the rides: where wear plates go.
  std::vector<WearStretch> plates;
};

/// @param rides  of streams, at least one; one that ends early counts as far as it goes
/// @throws InputError if there is none, or one is of no stream
[[nodiscard]] WearFacts wear_of(const std::vector<const Motion*>& rides);

/// A liner under Archard's law: thickness lost in each second is k p v_slip/hardness.
struct LinerWear {
  double coefficient = 0.0;  ///< k [-]; > 0
  double hardness = 0.0;     ///< [Pa]; > 0
};

/// @param floor_wear  W_c = mu p v_slip [W/m^2]
/// @param friction    mu; > 0
/// @return thickness lost [m/s]
[[nodiscard]] double thickness_loss_rate(const LinerWear& liner, double floor_wear, double friction);

}  // namespace glissade
