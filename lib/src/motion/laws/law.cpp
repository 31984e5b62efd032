#include "glissade/motion/law.hpp"

#include "glissade/core/error.hpp"

#include <string>

namespace glissade {

Resistance Law::resistance(double /*s*/, double /*v*/) const {
  return {};
}

double Law::quantity(std::size_t index, const LawState& /*state*/) const {
  throw InternalError(
      {"", "the law " + std::string(kind()) + " has no quantity " + std::to_string(index), "", ""});
}

LawPtr Law::from(double /*s*/) const {
  return nullptr;
}

double Law::least_v(double /*s*/) const {
  return 0.0;
}

}  // namespace glissade
