#include "glissade/route/placement.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <cmath>

namespace glissade {
namespace {

void require_finite(const char* name, Vec3 point) {
  if (std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z)) return;
  throw InputError({"",
                    std::string(name) + ": (" + exact_text(point.x) + ", " + exact_text(point.y) + ", " +
                        exact_text(point.z) + ") m is not a position",
                    "Every coordinate is a finite number of metres.", ""});
}

}  // namespace

Placement::Placement(Vec3 start, Angle azimuth)
    : start_(start), cos_(math::cos(azimuth.radians())), sin_(math::sin(azimuth.radians())) {
  require_finite("start", start);
  if (!std::isfinite(azimuth.radians())) {
    throw InputError({"", "azimuth: " + exact_text(azimuth.degrees()) + " deg is not a direction",
                      "An azimuth is a finite angle.", ""});
  }
}

Placement Placement::through(Vec3 start, Vec3 finish) {
  require_finite("start", start);
  require_finite("finish", finish);
  Placement placement;
  placement.start_ = start;
  const double run = math::hypot(finish.x - start.x, finish.y - start.y);
  if (run > 0.0) {
    placement.cos_ = (finish.x - start.x) / run;
    placement.sin_ = (finish.y - start.y) / run;
  }
  return placement;
}

Placement Placement::at_origin() const {
  Placement placement = *this;
  placement.start_ = {};
  return placement;
}

Angle Placement::azimuth() const {
  return Angle::from_radians(math::atan2(sin_, cos_));
}

}  // namespace glissade
