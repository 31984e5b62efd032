#pragma once

#include "glissade/core/error.hpp"

#include "parts/plate_joints.hpp"

#include <string>
#include <vector>

namespace glissade::parts {

/// Rules of the shop about holes, sizes and masses, of any parts, each with its worst place.
[[nodiscard]] std::vector<ShopCheck> part_checks(const PlateOptions& options, const Workshop& workshop);
/// Whether plate rolls give a radius.
[[nodiscard]] ShopCheck rolling_check(double radius, double thickness, const std::string& where);

/// What no shop can make of options alone, whatever the section is.
[[nodiscard]] std::vector<Issue> common_problems(const PlateOptions& options);

/// Those of a channel: of parts, and of its floor.
[[nodiscard]] std::vector<ShopCheck> shop_checks(const Job& job, const std::vector<Unit>& units,
                                                 const Workshop& workshop);

}  // namespace glissade::parts
