#pragma once

#include "parts/plates/plate_joints.hpp"

#include <cstddef>
#include <vector>

namespace glissade::parts {

/// Holds the parts against the channel, against each other, and against their patterns.
/// @throws InternalError if plates do not add up, parts clash or edges differ
[[nodiscard]] PartsProof prove(const Job& job, const std::vector<Unit>& units, const Workshop& workshop);

}  // namespace glissade::parts
