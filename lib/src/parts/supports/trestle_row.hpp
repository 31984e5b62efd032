#pragma once

#include "parts/plates/shell.hpp"
#include "parts/supports/trestle.hpp"

#include <vector>

namespace glissade::parts {

/// Along the track, and half of the length of a trestle's saddles there [m].
struct TrestlePlace {
  double at = 0.0;
  double half = kSaddleHalf;
};

/// A trestle to be: where it stands, and what it takes up to either side along the track [m].
struct Standing {
  TrestlePlace place;
  double clear = 0.0;
  Saddles saddles;
  Trestle trestle;
};

using Trestles = std::vector<Standing>;  // from upstream to downstream

/// @pre shell.options.supports
/// @return the fewest that are no farther apart than is asked for; where none are, those that come nearest to it
[[nodiscard]] Trestles trestles_along(const Shell& shell);

}  // namespace glissade::parts
