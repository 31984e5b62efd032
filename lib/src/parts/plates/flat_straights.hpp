#pragma once

#include "parts/bodies/facets.hpp"
#include "parts/plates/shell.hpp"

#include <vector>

namespace glissade::parts {

/// Adds what of the flats of a unit is straight at all of some heights: between the planes in which they meet.
/// @param heights  above the flats, the lowest and the highest
void add_straights(const ArcSpline& track, const Facets& facets, const Span& heights,
                   std::vector<Straight>& straights);

}  // namespace glissade::parts
