#pragma once

#include "glissade/design/design.hpp"

#include <filesystem>
#include <string>

namespace glissade {

/// A design as the text of a design file.
///
/// Identity: parse_design(design_text(d), d.file) is d but for Design::locations, for every d that parse_design() can
///   return; the direction of a half-plane whose line is neither level nor vertical to rounding. Comments and
///   the spelling of values are not kept: each number is the shortest decimal, in a metric unit, that reads as
///   the very same value.
/// @return UTF-8 where the design's texts are, ending in a newline
[[nodiscard]] std::string design_text(const Design& design);

/// A design that is to be written to another file than it was read from: what it names (points, sets of rules) is then
/// seen from there.
/// @param file  becomes Design::file
[[nodiscard]] Design moved_to(Design design, const std::filesystem::path& file);

}  // namespace glissade
