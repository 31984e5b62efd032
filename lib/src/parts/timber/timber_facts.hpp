#pragma once

#include "parts/timber/timber_frame.hpp"

#include <vector>

namespace glissade::parts {

/// What rules of the shop may bound of timber; the workshop has the parts already.
void measure_timber(const TimberJob& job, const std::vector<std::vector<DeckRow>>& rows,
                    const std::vector<CrossMember>& members, const BearerPlan& bearers,
                    const std::vector<Leg>& legs, Workshop& workshop);

}  // namespace glissade::parts
