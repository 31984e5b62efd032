#pragma once

#include <string>

namespace glissade {

/// What the place of a probe counts from.
enum class ProbeOrigin {
  start,   ///< arc length from the start
  finish,  ///< arc length back from the finish
  x        ///< the design's x, as its limits have it
};

/// A place on the track whose speed, slope angle and load a design asks for.
struct ProbeDesign {
  std::string name;  ///< may be empty
  ProbeOrigin origin = ProbeOrigin::start;
  double at = 0.0;  ///< [m]; of start and finish >= 0

  friend bool operator==(const ProbeDesign&, const ProbeDesign&) = default;
};

}  // namespace glissade
