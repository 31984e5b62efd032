#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace glissade {

/// The schema of a design file, for editors that check and complete YAML while it is written.
///
/// Made by the reader itself: every key, dimension, unit and word in it is one that read_design() asks for.
/// Identity: it accepts every file that read_design() accepts; what it refuses, read_design() refuses. What
///   values must be to one another it does not know.
/// @return JSON Schema draft-07, UTF-8, ending in a newline
[[nodiscard]] std::string design_schema();

/// One place of a design file that takes a value.
struct DesignKey {
  std::string path;                ///< names joined by dots: "limits.slope_angle.highest"
  std::vector<std::string> words;  ///< that the value may be, if it may be one
  bool list = false;               ///< of such words
};

/// @return every value that `--set` can replace, in the order of the schema; those within lists excepted
[[nodiscard]] std::vector<DesignKey> design_keys();

/// What a schema is called that lies beside a design file.
inline constexpr std::string_view kSchemaName = "glissade.schema.json";

}  // namespace glissade
