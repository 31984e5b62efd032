#pragma once

#include <string>
#include <string_view>

namespace glissade {

/// The schema of a design file, for editors that check and complete YAML while it is written.
///
/// Made by the reader itself: every key, dimension, unit and word in it is one that read_design() asks for.
/// Identity: it accepts every file that read_design() accepts; what it refuses, read_design() refuses. What
///   values must be to one another it does not know.
/// @return JSON Schema draft-07, UTF-8, ending in a newline
[[nodiscard]] std::string design_schema();

/// What a schema is called that lies beside a design file.
inline constexpr std::string_view kSchemaName = "glissade.schema.json";

}  // namespace glissade
