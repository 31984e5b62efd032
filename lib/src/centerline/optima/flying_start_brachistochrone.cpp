// Both parts by their radius of curvature over the slope angle: c^2/(g cos^3) of the flight, and of the pressed
// part, with e = E cos^2 = (sin - mu cos)^2 + q^2 cos^2, which stays finite where the slope does not,
//
//     ds/d|zeta| = C cos [e + 4 mu cos (sin - t1 cos)]/e^3,   C = c^2 E(t_j)^2/g
#include "glissade/centerline/flying_start_brachistochrone.hpp"

#include "glissade/core/math.hpp"

#include "centerline/optima/slope_table.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace glissade {
namespace {

using centerline::SlopeTable;

/// Sine and cosine of a slope angle.
struct Lean {
  double sine = 0.0;
  double cosine = 0.0;
};

Lean lean_of(double slope_angle) {
  return {math::sin(slope_angle), math::cos(slope_angle)};
}

/// The lean where the slope angle is that of a slope and `turn` more. Beside the vertical the cosine follows from the slope,
/// which tells how far from it that is, with all digits; the angle does not.
Lean turned_lean(double slope, double slope_angle, double turn) {
  constexpr double kSteepSlope = 10.0;  // accuracy: of less the angle has the digits of kPositionAccuracy
  if (std::fabs(slope) < kSteepSlope) return lean_of(slope_angle + turn);
  const double cosine = 1.0 / math::hypot(1.0, slope);
  const double sine = slope * cosine;
  const auto [turn_sine, turn_cosine] = math::sine_cosine(turn);
  return {sine * turn_cosine + cosine * turn_sine, cosine * turn_cosine - sine * turn_sine};
}

double flight_radius(const FlyingStartSolution& solution, const Lean& lean) {
  const double cosine = lean.cosine;
  const double speed = solution.shape.horizontal_speed;
  return speed * speed / (solution.gravity * cosine * cosine * cosine);
}

double pressed_radius(const FlyingStartSolution& solution, const Lean& lean) {
  const FlyingStartShape& shape = solution.shape;
  const double mu = shape.friction_coefficient;
  const double q2 = 1.0 - mu * mu + 2.0 * mu * shape.exit_slope;
  const auto [sine, cosine] = lean;
  const double off = sine - mu * cosine;
  const double e = off * off + q2 * cosine * cosine;
  const double speed = shape.horizontal_speed * shape.flight_end_e;
  const double scale = speed * speed / solution.gravity;
  return scale * cosine * (e + 4.0 * mu * cosine * (sine - shape.exit_slope * cosine)) / (e * e * e);
}

/// @return slope angle of the straight line to the finish
double straight_slope(const Endpoints& ends) {
  return math::atan2(ends.drop, std::fabs(ends.run));
}

/// @return atan(to) - atan(from), with no digits lost where they are close
double turn_between(double from, double to) {
  return math::atan2(to - from, 1.0 + from * to);
}

}  // namespace

FlyingStartBrachistochrone::FlyingStartBrachistochrone(const Endpoints& endpoints, Friction friction,
                                                       double entry_speed, double gravity)
    : solution_(solve_flying_start(endpoints, friction, entry_speed, gravity)) {
  if (solution_.limit == FlyingStartLimit::rest) {
    rest_ = std::make_shared<CoulombBrachistochrone>(endpoints, friction, gravity);
    length_ = rest_->length();
    return;
  }
  const FlyingStartShape& shape = solution_.shape;
  // measured: beside a vertical its slopes tell a track of this run to 1e-7 of its length, the straight line to 1e-9
  constexpr double kSteep = 1e-9;
  if (shape.horizontal_speed == 0.0 || std::fabs(endpoints.run) < kSteep * std::fabs(endpoints.drop)) {
    length_ = math::hypot(endpoints.run, endpoints.drop);
    return;
  }
  const double flown = math::atan2(shape.flight_turn, 1.0 + shape.entry_slope * shape.flight_end_slope);
  if (flown > 0.0) {
    const double entry = solution_.entry_slope_angle.radians();
    flight_ = std::make_shared<SlopeTable>(entry, flown, [&](double turn) {
      return flight_radius(solution_, turned_lean(shape.entry_slope, entry, turn));
    });
    flight_length_ = flight_->length();
  }
  const double pressed = turn_between(shape.flight_end_slope, shape.exit_slope);
  if (pressed < 0.0) {
    const double begin = solution_.flight_end_slope_angle.radians();
    pressed_ = std::make_shared<SlopeTable>(begin, pressed, [&](double turn) {
      return pressed_radius(solution_, turned_lean(shape.flight_end_slope, begin, turn));
    });
  }
  length_ = flight_length_ + (pressed_ ? pressed_->length() : 0.0);
}

double FlyingStartBrachistochrone::beyond_start(double s) const {
  return std::max(s, kRestShare * kRestShare * length_);
}

double FlyingStartBrachistochrone::slope_angle(double s) const {
  require_on_track(s);
  if (rest_) return rest_->slope_angle(s);
  if (flight_ && (s < flight_length_ || !pressed_)) return flight_->slope_angle(s);
  return pressed_ ? pressed_->slope_angle(s - flight_length_) : straight_slope(solution_.endpoints);
}

double FlyingStartBrachistochrone::curvature(double s, double slope_angle) const {
  if (flight_ && (s < flight_length_ || !pressed_))
    return -1.0 / flight_radius(solution_, lean_of(slope_angle));
  return pressed_ ? 1.0 / pressed_radius(solution_, lean_of(slope_angle)) : 0.0;
}

Direction FlyingStartBrachistochrone::direction(double s) const {
  if (rest_) return {rest_->slope_angle(s), rest_->direction(beyond_start(s)).curvature};
  const double zeta = slope_angle(s);
  return {zeta, curvature(s, zeta)};
}

CenterlinePoint FlyingStartBrachistochrone::at(double s) const {
  require_on_track(s);
  if (rest_) {
    CenterlinePoint point = rest_->at(s);
    point.curvature = rest_->direction(beyond_start(s)).curvature;
    return point;
  }
  const Endpoints& ends = solution_.endpoints;
  SlopeTable::Point point{straight_slope(ends), s * (std::fabs(ends.run) / length_),
                          s * (ends.drop / length_)};
  if (flight_ && (s < flight_length_ || !pressed_)) {
    point = flight_->at(s);
  } else if (pressed_) {
    point = pressed_->at(s - flight_length_);
    point.x += solution_.flight.run;
    point.drop += solution_.flight.drop;
  }
  return {s, point.x, point.drop, point.slope_angle, curvature(s, point.slope_angle)};
}

bool FlyingStartBrachistochrone::unbounded_curvature_at_start() const noexcept {
  return rest_ && rest_->unbounded_curvature_at_start();
}

std::vector<double> FlyingStartBrachistochrone::breaks() const {
  if (rest_) return rest_->breaks();
  if (flight_ && pressed_) return {0.0, flight_length_, length_};
  return {0.0, length_};
}

}  // namespace glissade
