#pragma once

#include "parts/plates/plate_section.hpp"

namespace glissade::parts {

/// Cuts plates that are wider than a strip may be along the track (seams.hpp). Of a floor that widens the middle strip takes
/// the change. Where openings lie in a plate that is cut, one strip holds them and their lids.
/// @throws InputError where no seams are to be had: which plate, and a way out
[[nodiscard]] PlateSection with_seams(const PlateSection& section, const PlateOptions& options);

}  // namespace glissade::parts
