#pragma once

#include "parts/prints/print_split.hpp"
#include "parts/prints/print_unit.hpp"

#include <vector>

namespace glissade::parts {

/// What rules of the shop may bound of prints; the workshop has their parts already.
void measure_prints(const PrintJob& job, const std::vector<PrintUnit>& units, const Hold& hold,
                    Workshop& workshop);

}  // namespace glissade::parts
