#include "glissade/centerline/centerline.hpp"

#include "glissade/core/error.hpp"

namespace glissade {

std::vector<double> Centerline::breaks() const {
  return {0.0, length()};
}

}  // namespace glissade
