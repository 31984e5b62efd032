// One track under the frictions of a range, or under any other.

#include "pipeline/friction_range.hpp"

#include "glissade/core/number_text.hpp"
#include "glissade/motion/stall_friction.hpp"
#include "glissade/pipeline/solve.hpp"

#include <algorithm>
#include <utility>

namespace glissade {

std::vector<LevelRide> Track::rides() const {
  std::vector<LevelRide> rides;
  for (const FrictionLevel level : kFrictionLevels) {
    if (level == FrictionLevel::nominal) rides.push_back({level, &motion});
    for (const RangeRide& ride : range) {
      if (ride.level == level) rides.push_back({level, &ride.motion});
    }
  }
  return rides;
}

namespace {

constexpr Angle kSteepest = Angle::from_degrees(89.9);

/// By as much as another friction changes from `before` to `behind`, in angle.
Friction shifted(Friction friction, Friction before, Friction behind) {
  if (friction == before) return behind;
  const double angle = friction.angle().radians() + behind.angle().radians() - before.angle().radians();
  return Friction::from_angle(Angle::from_radians(std::clamp(angle, 0.0, kSteepest.radians())));
}

}  // namespace

Track ride_at(Design design, const CenterlinePtr& centerline, const Friction& friction) {
  // Where friction changes along the track all of it shifts by the same angle, as for the stall margin.
  const Friction before = design.body.friction;
  for (FrictionFrom& change : design.body.friction_changes)
    change.friction = shifted(change.friction, before, friction);
  design.body.friction = friction;
  design.body.low_friction.reset();
  design.body.high_friction.reset();
  // Not searched: where the objective would count the highest friction does not matter.
  design.objective.worst_case = false;
  return ride(design, centerline);
}

std::optional<Angle> stall_angle_of(const Track& track) {
  if (!lands(track.motion)) return {};
  return stall_friction_angle(track.centerline, track.motion.body(), track.motion.gravity());
}

namespace pipeline {

std::vector<RangeRide> rides_of_range(const Design& design, const CenterlinePtr& centerline) {
  std::vector<RangeRide> rides;
  const auto add = [&](FrictionLevel level, const std::optional<Friction>& friction) {
    if (!friction) return;
    Body body = body_of(design);
    body.friction = *friction;
    rides.push_back({level, Motion(centerline, body, design.gravity)});
  };
  add(FrictionLevel::low, design.body.low_friction);
  add(FrictionLevel::high, design.body.high_friction);
  return rides;
}

std::string at_friction_text(const LevelRide& ride) {
  return "at " + std::string(to_text(ride.level)) + " friction, " +
         angle_text(ride.motion->body().friction.angle());
}

}  // namespace pipeline
}  // namespace glissade
