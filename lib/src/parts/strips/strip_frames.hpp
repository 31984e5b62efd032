#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_shape.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// Frames round both ends of every unit of strips, one for each joint and side.

/// @param bent  none: the plates are rolled
void add_strip_frames(const StripJob& job, const std::optional<BentStrips>& bent,
                      const std::vector<double>& joints, Workshop& workshop);

/// Widens the gap of frames that nobody told where plates that begin or bend close behind one would stand in it.
/// @throws InputError where the gap was told: the place, and the gap that would do
[[nodiscard]] FlangeOptions frames_that_clear(const StripJob& job, const std::vector<double>& joints,
                                              const std::vector<Strip>& strips);

}  // namespace glissade::parts
