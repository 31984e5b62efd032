#pragma once

#include "glissade/design/ends_design.hpp"
#include "glissade/design/stream_design.hpp"
#include "glissade/trades/chute/materials.hpp"

#include <string>

/// What a stream of bulk solid has beside its track, written back.
namespace glissade::design_file {

[[nodiscard]] std::string written_bulk_material(const Material& design);
[[nodiscard]] std::string written_feed(const FeedDesign& design);
[[nodiscard]] std::string written_hood(const HoodDesign& design);
[[nodiscard]] std::string written_discharge(const DischargeDesign& design);
[[nodiscard]] std::string written_stream(const StreamDesign& design);

}  // namespace glissade::design_file
