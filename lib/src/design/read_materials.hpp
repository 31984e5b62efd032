#pragma once

#include "glissade/trades/chute/materials.hpp"

#include "design/map_reader.hpp"

#include <map>
#include <string>
#include <vector>

namespace glissade::design_file {

/// Sources by their key in a file.
using SourceKeys = std::map<std::string, MaterialSource, std::less<>>;

/// Reads the list `materials` of a file or a design.
/// @param sources  none: a source is told in words, and is the user's own
[[nodiscard]] std::vector<Material> read_materials(MapReader& top, const SourceKeys* sources,
                                                   Findings& findings);

}  // namespace glissade::design_file
