#pragma once

#include "glissade/pipeline.hpp"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace glissade::app {

/// The objects that --json prints; docs/cli.md lists their keys. SI values with the unit in the key, every
/// number with all digits that a double carries, null where a value does not exist or is infinite.

[[nodiscard]] nlohmann::ordered_json track_json(const Design& design, const Track& track);
/// A design whose limits no track keeps: what contradicts each other, and what would do.
[[nodiscard]] nlohmann::ordered_json conflict_json(const Design& design, const OptimizeReport& report);
[[nodiscard]] nlohmann::ordered_json facts_json(const MeshFacts& facts);
[[nodiscard]] nlohmann::ordered_json build_json(const Design& design, const Build& build);
/// What the tracks of a comparison have in common.
[[nodiscard]] nlohmann::ordered_json input_json(const Design& design);

/// @return the document as --json prints it, with a newline at the end
[[nodiscard]] std::string document(const nlohmann::ordered_json& json);

}  // namespace glissade::app
