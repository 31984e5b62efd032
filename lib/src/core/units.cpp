#include "glissade/core/units.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"

#include <cmath>

namespace glissade {

Friction Friction::from_angle(Angle angle) {
  const double radians = angle.radians();
  if (!(radians >= 0.0 && radians < kRightAngle)) {
    throw InputError(
        {"",
         "friction angle " + quantity_beyond(radians, Dimension::angle, {0.0, kRightAngle}) +
             " is out of range",
         "A friction angle lies between 0 and 90 deg (90 excluded).",
         "the angle at which the material just starts to slide on the track, often 10 to 40 deg"});
  }
  return Friction(math::tan(radians));
}

Friction Friction::from_coefficient(double mu) {
  if (!(mu >= 0.0 && std::isfinite(mu))) {
    throw InputError({"", "friction coefficient " + rounded_text(mu, 6) + " is out of range",
                      "A friction coefficient is a finite number, 0 or larger.",
                      "the tangent of the friction angle, often 0.02 to 0.8"});
  }
  return Friction(mu);
}

Angle Friction::angle() const {
  return Angle::from_radians(math::atan(coefficient_));
}

}  // namespace glissade
