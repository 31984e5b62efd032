#pragma once

#include "glissade/parts/workshop_build.hpp"

#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_shape.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// Says how strips are bent, meet, are mirrored, lean and end.
/// @param bent  none: the plates are rolled
void add_strip_notes(const StripJob& job, const std::optional<BentStrips>& bent, const PartsProof& proof,
                     const std::vector<Strip>& strips, Workshop& workshop);

}  // namespace glissade::parts
