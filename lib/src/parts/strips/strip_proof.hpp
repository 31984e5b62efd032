#pragma once

#include "glissade/parts/workshop_build.hpp"

#include "parts/strips/bent_strips.hpp"
#include "parts/strips/strip_shape.hpp"
#include "parts/strips/strip_works.hpp"

#include <optional>
#include <vector>

namespace glissade::parts {

/// What laps, tabs, slots and holes make more or less than mitred plates are, in closed form but for holes in leaning ones.
[[nodiscard]] std::vector<VolumeDifference> cut_differences(const StripJob& job,
                                                            const std::vector<Strip>& strips,
                                                            const std::vector<UnitWork>& works);

/// Volumes and edges of strips against the section's outline, and every part against every other.
/// @param bent  none: the plates are rolled
/// @param cut   by which they differ from mitred ones
/// @throws InternalError where they do not agree, or clash
[[nodiscard]] PartsProof prove_strips(const StripJob& job, const std::optional<BentStrips>& bent,
                                      const std::vector<Strip>& strips, const std::vector<double>& joints,
                                      const std::vector<VolumeDifference>& cut, const Workshop& workshop);

}  // namespace glissade::parts
