#pragma once

#include "glissade/parts/shop_part.hpp"

#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_shape.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// Frames round both ends of every unit of strips, one for each joint and side.

/// The line round which frames go: a section's outside without what of its rims folds back over it. Of those the frame's edge
/// would run into the frame.
/// @param ring  whether it is closed: then nothing is left out
[[nodiscard]] std::vector<Vec2> line_of_frames(std::vector<Vec2> outside, bool ring,
                                               const FlangeOptions& frame);

/// @param bent  none: the plates are rolled
/// @throws InputError where a frame would run into itself
void add_strip_frames(const StripJob& job, const std::optional<BentStrips>& bent,
                      const std::vector<double>& joints, Workshop& workshop);

/// Widens the gap of frames that nobody told where plates that begin or bend close behind one would stand in it.
/// @throws InputError where the gap was told: the place, and the gap that would do
[[nodiscard]] FlangeOptions frames_that_clear(const StripJob& job, const std::vector<double>& joints,
                                              const std::vector<Strip>& strips);

}  // namespace glissade::parts
