#pragma once

#include "parts/plate_joints.hpp"

#include <vector>

namespace glissade::parts {

/// Rules of the shop held against the parts, each with its worst place.
[[nodiscard]] std::vector<ShopCheck> shop_checks(const Job& job, const std::vector<Unit>& units,
                                                 const Workshop& workshop);

}  // namespace glissade::parts
