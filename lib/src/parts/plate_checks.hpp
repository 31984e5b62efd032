#pragma once

#include "glissade/core/error.hpp"
#include "glissade/parts/plate_options.hpp"

#include <vector>

namespace glissade::parts {

/// What no shop can make of options alone, whatever the section is.
[[nodiscard]] std::vector<Issue> common_problems(const PlateOptions& options);

/// Of a punch that is sharper than the material stands.
[[nodiscard]] Issue too_tight_a_bend(double radius, double thickness);

}  // namespace glissade::parts
