#pragma once

#include "glissade/parts/plate_options.hpp"
#include "glissade/section/measures.hpp"

#include <optional>

namespace glissade {

/// How a workshop makes the track: `fabrication` of a design file.
struct FabricationDesign {
  double arc_tolerance = 1e-4;  ///< greatest distance between the track and its arcs [m]; > 0
  PlateOptions plate;

  friend bool operator==(const FabricationDesign&, const FabricationDesign&) = default;
};

/// @return what a cross-section is as a channel of flat plates; none where it is no such channel
[[nodiscard]] std::optional<ChannelMeasures> channel_of(const section::Measures& measures);

}  // namespace glissade
