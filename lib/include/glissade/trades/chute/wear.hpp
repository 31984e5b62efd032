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
  ValueAt floor;         ///< greatest wear factor W_c of the floor [W/m^2]
  std::size_t ride = 0;  ///< the one that it is of
  /// Greatest p v_slip = W_c/mu of the floor [W/m^2], by which a liner gets thinner: not where W_c is greatest if mu
  /// differs between the rides, but at the least of them as a rule, where the stream is fastest.
  ValueAt pressed;
  std::size_t pressed_ride = 0;  ///< the one that it is of
  ValueAt wall;                  ///< greatest of the side walls, below the surface [W/m^2]
  double mean_floor = 0.0;       ///< mean W_c of that ride along the track [W/m^2]
  /// Where the floor wears at least half as fast as at its peak on any of the rides, to 1e-7 m: where wear plates go.
  std::vector<WearStretch> plates;
};

/// @param rides  of streams, at least one; one that ends early counts as far as it goes
/// @throws InputError if there is none, or one is null or of no stream
[[nodiscard]] WearFacts wear_of(const std::vector<const Motion*>& rides);

/// A liner under Archard's law: thickness lost in each second is k p v_slip/hardness.
struct LinerWear {
  double coefficient = 0.0;  ///< k [-]; > 0
  double hardness = 0.0;     ///< [Pa]; > 0
};

/// @param pressed  p v_slip [W/m^2]
/// @return thickness lost [m/s]
[[nodiscard]] double thickness_loss_rate(const LinerWear& liner, double pressed);

/// What a floor has to stand at one place of its track, the most over several rides.
struct FloorLoad {
  double at = 0.0;       ///< arc length [m]
  double wear = 0.0;     ///< W_c [W/m^2]
  double pressed = 0.0;  ///< p v_slip [W/m^2]
};
/// @param rides  as for wear_of()
/// @throws InputError as wear_of()
/// @return by ascending places, close enough for what changes with load and width
[[nodiscard]] std::vector<FloorLoad> floor_loads(const std::vector<const Motion*>& rides);

}  // namespace glissade
