#pragma once

#include "parts/plates/shell.hpp"

namespace glissade::parts {

/// @return the outside of a channel of one width
[[nodiscard]] SectionOutside channel_outside(const ChannelMeasures& channel, const PlateOptions& options);

/// A channel as what lugs and trestles are set on.
[[nodiscard]] Shell channel_shell(const Job& job, const std::vector<Unit>& units, Workshop& workshop,
                                  TakenUp& taken);

}  // namespace glissade::parts
