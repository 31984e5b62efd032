#pragma once

#include "glissade/design/design.hpp"

#include "design/map_reader.hpp"

#include <filesystem>
#include <optional>

namespace glissade::design_file {

/// Reads the `fabrication:` section; none where there is none.
/// @param folder  of the design file: paths are taken from there
[[nodiscard]] std::optional<FabricationDesign> read_fabrication(MapReader& top,
                                                                const std::filesystem::path& folder,
                                                                Findings& findings);

}  // namespace glissade::design_file
