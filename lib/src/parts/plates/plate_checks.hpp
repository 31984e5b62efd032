#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/plate_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace glissade::parts {

/// What no shop can make of options alone, whatever the section is.
[[nodiscard]] std::vector<Issue> common_problems(const PlateOptions& options);

/// Of a channel whose walls follow the arcs of the track.
[[nodiscard]] std::vector<Issue> channel_problems(const ChannelMeasures& channel,
                                                  const PlateOptions& options);

/// Of a punch that is sharper than the material stands.
/// @param part  whose thickness it is
/// @return none of one that is not
[[nodiscard]] std::optional<Issue> too_tight_a_bend(double thickness, const PlateOptions& options,
                                                    const std::string& part = "plate");

}  // namespace glissade::parts
