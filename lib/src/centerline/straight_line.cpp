#include "glissade/centerline/straight_line.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <cmath>

namespace glissade {

StraightLine::StraightLine(const Endpoints& endpoints)
    : run_(std::fabs(endpoints.run)),
      drop_(endpoints.drop),
      length_(math::hypot(run_, drop_)),
      slope_angle_(math::atan2(drop_, run_)) {
  if (!std::isfinite(length_)) {
    const bool are_finite = std::isfinite(endpoints.run) && std::isfinite(endpoints.drop);
    throw InputError({"",
                      "endpoints: run " + exact_text(endpoints.run) + " m, drop " +
                          exact_text(endpoints.drop) + " m are " +
                          (are_finite ? "too far apart" : "not finite"),
                      are_finite ? "The way between them is beyond the range of numbers."
                                 : "A track leads from one point to another.",
                      "plain numbers in metres"});
  }
  if (length_ == 0.0) {
    throw InputError({"", "start and finish are the same point", "A straight track needs a length.",
                      "a finish below the start"});
  }
}

CenterlinePoint StraightLine::at(double s) const {
  require_on_track(s);
  const double fraction = s / length_;
  return {s, fraction * run_, fraction * drop_, slope_angle_, 0.0};
}

double StraightLine::slope_angle(double s) const {
  require_on_track(s);
  return slope_angle_;
}

}  // namespace glissade
