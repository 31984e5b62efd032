#pragma once

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <cmath>
#include <string>

namespace glissade::motion {

/// @throws InputError unless a measure of a body is positive and finite
inline void require_positive(const char* name, double value, const char* unit, const char* why) {
  if (value > 0.0 && std::isfinite(value)) return;
  throw InputError(
      {"", std::string(name) + ": " + exact_text(value) + unit + " is not a finite number larger than 0", why,
       ""});
}

}  // namespace glissade::motion
