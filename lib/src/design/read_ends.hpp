#pragma once

#include "glissade/design/ends_design.hpp"

#include "design/map_reader.hpp"

#include <optional>

namespace glissade::design_file {

/// Read the groups `feed`, `hood` and `discharge`, if the file has them.
[[nodiscard]] std::optional<FeedDesign> read_feed(MapReader& top, Findings& findings);
[[nodiscard]] std::optional<HoodDesign> read_hood(MapReader& top, Findings& findings);
[[nodiscard]] std::optional<DischargeDesign> read_discharge(MapReader& top, Findings& findings);

}  // namespace glissade::design_file
