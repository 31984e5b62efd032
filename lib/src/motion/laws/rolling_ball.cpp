#include "glissade/motion/laws/rolling_ball.hpp"

#include "glissade/core/math.hpp"

#include "motion/laws/requirement.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace glissade {
namespace {

constexpr double kSolidBall = 2.0 / 5.0;  // moment of inertia over m r^2

double spread_of(const BallShape& shape) {
  const double angle = shape.groove_half_angle.radians();
  if (angle > 0.0 && angle <= 0.5 * std::numbers::pi) return math::sin(angle);
  throw InputError(
      {"",
       "groove_half_angle: " + angle_text(Angle::from_radians(angle)) + " is not above 0 and at most 90 deg",
       "Half of the angle between the walls of the groove; 90 deg is a flat floor.", ""});
}

}  // namespace

RollingBall::RollingBall(const BallShape& shape)
    : shape_(shape),
      spread_(spread_of(shape)),
      inertia_(1.0 + kSolidBall / (spread_ * spread_)),
      height_(shape.centre_height.value_or(shape.radius)) {
  motion::require_positive("radius", shape.radius, " m", "A ball has a size.");
  motion::require_positive("centre_height", height_, " m", "The ball lies on the track.");
}

std::vector<LawQuantity> RollingBall::quantities() const {
  LawQuantity needed{"friction_needed", "friction that rolling needs", "", {}, false};
  needed.verdict = {"The ball rolls and does not slip", "it does not slip", "the ball slips",
                    "The ride is that of a ball that rolls all the way.",
                    "a track less steep (limits: slope_angle), or a ball and a track that grip better"};
  if (shape_.grip) needed.highest = shape_.grip->coefficient();
  return {needed};
}

double RollingBall::quantity(std::size_t index, const LawState& state) const {
  if (index != 0) return Law::quantity(index, state);
  // One that is held from both sides rolls on whichever it presses.
  const double load = std::fabs(state.normal_load);
  const double resisting = state.friction * load;
  const double acceleration = (state.drive - resisting) / inertia_;
  const double force = std::fabs((inertia_ - 1.0) * acceleration + resisting);
  if (force == 0.0) return 0.0;
  const double pressed = load / spread_;
  return pressed > 0.0 ? force / pressed : std::numeric_limits<double>::infinity();
}

LawPtr RollingBall::in_units(double length, double /*speed*/) const {
  BallShape scaled = shape_;
  scaled.radius /= length;
  if (scaled.centre_height) *scaled.centre_height /= length;
  return std::make_shared<const RollingBall>(scaled);
}

}  // namespace glissade
