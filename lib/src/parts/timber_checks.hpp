#pragma once

#include "parts/timber_frame.hpp"

#include <vector>

namespace glissade::parts {

/// The rules of carpentry, held against the parts.
[[nodiscard]] std::vector<ShopCheck> timber_checks(const TimberJob& job,
                                                   const std::vector<std::vector<DeckRow>>& rows,
                                                   const std::vector<CrossMember>& members,
                                                   const BearerPlan& bearers, const std::vector<Leg>& legs,
                                                   const Workshop& workshop);

}  // namespace glissade::parts
