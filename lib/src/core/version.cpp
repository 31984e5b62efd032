#include "glissade/core/version.hpp"

namespace glissade {

std::string_view version() {
  return GLISSADE_VERSION;
}

}  // namespace glissade
