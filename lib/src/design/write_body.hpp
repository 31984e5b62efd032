#pragma once

#include "glissade/design/body_design.hpp"

#include <string>

namespace glissade::design_file {

/// @return the keys of a body, a line each
[[nodiscard]] std::string written_body(const BodyDesign& design);

}  // namespace glissade::design_file
