#include "report/body_energy.hpp"

#include "glissade/core/math.hpp"

#include "report/ride_stations.hpp"

#include <algorithm>

namespace glissade::report {

BodyEnergy::BodyEnergy(const Motion& motion)
    : motion_(motion),
      inertia_(motion.body().law ? motion.body().law->inertia() : 1.0),
      height_(motion.body().law ? motion.body().law->centre_height() : 0.0) {
  for (const double s : ride_stations(motion)) lowest_ = std::max(lowest_, centre_drop(s));
}

double BodyEnergy::potential(const MotionState& state) const {
  return motion_.gravity() * (lowest_ - centre_drop(state.arc_length));
}

double BodyEnergy::kinetic(const MotionState& state) const noexcept {
  return 0.5 * inertia_ * state.speed * state.speed;
}

double BodyEnergy::centre_drop(double s) const {
  const Centerline& track = motion_.centerline();
  const double rise = math::cos(track.slope_angle(s)) - math::cos(track.slope_angle(0.0));
  return track.at(s).drop - height_ * rise;
}

}  // namespace glissade::report
