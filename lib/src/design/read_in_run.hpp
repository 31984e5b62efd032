#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

namespace glissade::design_file {

/// The keys of a centerline of kind in-run.
void read_in_run(MapReader& map, InRunDesign& in_run, Findings& findings);

/// Reads the group `hill`, if there is one.
[[nodiscard]] HillDesign read_hill(MapReader& top, Findings& findings);

/// The words of in-run.transition and of e_counts_to.
[[nodiscard]] std::string_view word(InRunTransition transition);

}  // namespace glissade::design_file
