#pragma once

#include "glissade/core/quantity.hpp"

#include <string>

namespace glissade::app {

/// The value of an option: a plain number counts in SI units, anything else as in a design file ("400 mm",
/// "11deg"). An angle needs its unit.
/// @param name  the option, for messages
/// @return SI, radians
/// @throws InputError if it is neither
[[nodiscard]] double option_value(const std::string& text, Dimension dimension, const std::string& name);

}  // namespace glissade::app
