// One track under the frictions of a range, or under any other.

#include "pipeline/task/friction_range.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/motion/stall_friction.hpp"
#include "glissade/pipeline/solve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

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

/// By how much friction changes at the start, and all along with it.
class FrictionShift {
 public:
  FrictionShift(const Design& design, const Friction& friction, double length)
      : design_(design), asked_(friction), from_(design.body.friction), length_(length) {}

  /// @param index  of the design's friction_changes
  [[nodiscard]] Friction of(std::size_t index) const {
    const Friction friction = design_.body.friction_changes[index].friction;
    if (asked_ == from_) return friction;
    if (friction == from_) return asked_;
    constexpr double kRounding = 1e-12;  // rounding: of angles there and back [rad]
    const double angle = friction.angle().radians() + by();
    const bool is_reached = design_.body.friction_changes[index].from < length_;
    if (is_reached && (angle < -kRounding || angle > steepest() + kRounding))
      throw InputError(beyond(index, angle));
    const Friction shifted = Friction::from_angle(Angle::from_radians(std::clamp(angle, 0.0, steepest())));
    return std::min(shifted, Friction::from_coefficient(kRoughest));
  }

 private:
  /// Down to hundredths of a degree [deg].
  [[nodiscard]] static double to_step(double radians) {
    constexpr double kSteps = 100.0;    // taste
    constexpr double kRounding = 1e-9;  // rounding: of a bound that is a step, less than of() allows
    return std::floor(kSteps * Angle::from_radians(radians).degrees() + kRounding) / kSteps;
  }
  [[nodiscard]] static double steepest() { return math::atan(kRoughest); }
  [[nodiscard]] double by() const { return asked_.angle().radians() - from_.angle().radians(); }

  [[nodiscard]] Issue beyond(std::size_t index, double angle) const {
    const FrictionFrom& change = design_.body.friction_changes[index];
    const bool below = angle < 0.0;
    const double room = (below ? 0.0 : steepest()) - change.friction.angle().radians();
    const double bound = from_.angle().radians() + room;
    const auto text = [](double radians, int digits) {
      return angle_text(Angle::from_radians(radians), digits);
    };
    constexpr int kDigits = 6;  // rounding: as many tell 89.994 deg from what is steeper
    return {design_.where("body.friction." + std::to_string(index)),
            "friction: " + angle_text(change.friction.angle()) + " from " + length_text(change.from) +
                " on would be " + text_beyond(angle, {0.0, steepest()}, text, below ? 4 : kDigits) +
                " with " + angle_text(asked_.angle()) + " at the start",
            "The start has " + angle_text(from_.angle()) +
                ": another friction there changes all of it by the same angle, here by " + text(by(), 4) +
                ", and friction lies between 0 deg and 89.994 deg.",
            below ? "at least " + angle_text(Angle::from_degrees(-to_step(-bound))) + " at the start"
                  : "at most " + angle_text(Angle::from_degrees(to_step(bound))) + " at the start"};
  }

  const Design& design_;
  Friction asked_;
  Friction from_;
  double length_;
};

}  // namespace

Design with_friction(Design design, const Friction& friction, double length) {
  const FrictionShift shift(design, friction, length);
  std::vector<Friction> along;
  for (std::size_t i = 0; i < design.body.friction_changes.size(); ++i) along.push_back(shift.of(i));
  for (std::size_t i = 0; i < along.size(); ++i) design.body.friction_changes[i].friction = along[i];
  design.body.friction = friction;
  design.body.low_friction.reset();
  design.body.high_friction.reset();
  // Where the objective would count the highest friction of a range does not matter: there is none.
  design.objective.worst_case = false;
  return design;
}

Track ride_at(Design design, const CenterlinePtr& centerline, const Friction& friction) {
  return ride(with_friction(std::move(design), friction, centerline->length()), centerline);
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
