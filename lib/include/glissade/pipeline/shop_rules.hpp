#pragma once

#include "glissade/parts/shop_part.hpp"
#include "glissade/trades/rules.hpp"

#include <vector>

namespace glissade {

/// Holds rules against what was measured of parts: of each rule the place that keeps it worst. A rule whose conditions hold
/// nowhere is left out, and one that the program carries where no part has what it asks about; another one without a
/// place cannot be judged.
[[nodiscard]] std::vector<ShopCheck> judge_shop(const std::vector<Rule>& rules, const Workshop& workshop);

}  // namespace glissade
