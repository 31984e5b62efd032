#pragma once

#include "parts/timber/timber_frame.hpp"

#include <vector>

namespace glissade::parts {

/// Boards that brace long legs: crossed between the outer legs of a row, on both its faces, and one way between rows, on the
/// outsides of the outer legs. In bays higher than wide one above the other.
/// @param workshop  is told between which legs no board finds room
/// @return parts, each with its places
[[nodiscard]] std::vector<ShopPart> brace_parts(const TimberJob& job, const std::vector<Leg>& legs,
                                                const BearerPlan& plan, Workshop& workshop);
/// @return whether a leg is so long that it is braced
[[nodiscard]] bool is_braced(const TimberJob& job, const Leg& leg, const BearerPlan& plan);

}  // namespace glissade::parts
