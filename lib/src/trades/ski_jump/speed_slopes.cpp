// Without wind v = u^2 obeys dv/ds = a - b v with a = 2 (1 - kappa h)(g sin - mu g cos), b = 2 (k (1 - kappa h) + mu kappa)
// (docs/theory.md, laws of motion, with f = 1 and c = mu), so that with Theta the angle turned from s' to s
//   B(s', s) = Int b = 2 k (s - s' - h Theta) + 2 mu Theta,   v(s) = v0 e^-B(s0, s) + Int a e^-B(s', s) ds'
// and each derivative is the integral of the derivative of a e^-B.

#include "glissade/core/math.hpp"
#include "glissade/trades/ski_jump/gates.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {
namespace {

/// v at a place and its derivatives, or what a stretch of the track adds to them.
struct Parts {
  double v = 0.0;
  double by_friction = 0.0;
  double by_drag = 0.0;

  Parts& operator+=(const Parts& other) {
    v += other.v;
    by_friction += other.by_friction;
    by_drag += other.by_drag;
    return *this;
  }
  friend Parts operator+(Parts a, const Parts& b) { return a += b; }
  friend Parts operator*(double factor, const Parts& parts) {
    return {factor * parts.v, factor * parts.by_friction, factor * parts.by_drag};
  }
};

class Linear {
 public:
  Linear(const Centerline& track, double place, const Body& body, double gravity)
      : track_(track),
        place_(place),
        end_slope_(track.slope_angle(place)),
        gravity_(gravity),
        mu_(body.friction.coefficient()),
        drag_(body.drag_per_metre),
        height_(body.law ? body.law->centre_height() : 0.0) {}

  /// What a metre at s adds to v at the place, and to its derivatives.
  [[nodiscard]] Parts density(double s) const {
    const Direction there = track_.direction(s);
    const double lever = 1.0 - there.curvature * height_;
    const double sine = math::sin(there.slope_angle);
    const double cosine = math::cos(there.slope_angle);
    const double theta = there.slope_angle - end_slope_;
    const double way = place_ - s - height_ * theta;
    const double left = math::exp(-2.0 * (drag_ * way + mu_ * theta));
    const double a = 2.0 * lever * gravity_ * (sine - mu_ * cosine);
    return {a * left, (-2.0 * lever * gravity_ * cosine - 2.0 * theta * a) * left, -2.0 * way * a * left};
  }

  [[nodiscard]] Parts between(double from, double to) const {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    Parts sum;
    const double half = 0.5 * (to - from);
    const double middle = from + half;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const double offset = half * Rule::abscissa()[i];
      Parts pair = density(middle + offset);
      if (offset != 0.0) pair += density(middle - offset);
      sum += half * Rule::weights()[i] * pair;
    }
    return sum;
  }

 private:
  const Centerline& track_;
  double place_;
  double end_slope_;
  double gravity_;
  double mu_;
  double drag_;
  double height_;
};

SpeedSlopes by_quadrature(const Centerline& track, double from_start, double place, const Body& body,
                          double gravity) {
  const Linear linear(track, place, body, gravity);
  std::vector<double> cuts = {from_start};
  for (const double at : track.breaks()) {
    if (at > from_start && at < place) cuts.push_back(at);
  }
  cuts.push_back(place);
  Parts sum;
  constexpr int kPieces = 4;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double width = (cuts[i] - cuts[i - 1]) / kPieces;
    for (int piece = 0; piece < kPieces; ++piece) {
      sum += linear.between(cuts[i - 1] + piece * width, cuts[i - 1] + (piece + 1) * width);
    }
  }
  const double twice_speed = 2.0 * std::sqrt(std::max(sum.v, 0.0));
  if (twice_speed == 0.0) return {};
  return {sum.by_friction / twice_speed, sum.by_drag / twice_speed,
          linear.density(from_start).v / twice_speed};
}

/// Central differences with steps that a ride to 1e-12 resolves to 1e-8 or better.
SpeedSlopes by_differences(const CenterlinePtr& track, double from_start, double place, const Body& body,
                           double gravity) {
  const auto speed = [&](const Body& other, double start) {
    const Motion motion = ride_from(track, start, other, gravity);
    return motion.at(std::min(place - start, motion.distance())).speed;
  };
  constexpr double kFrictionStep = 1e-4;
  constexpr double kDragStep = 1e-6;    // [1/m]
  constexpr double kLengthStep = 1e-3;  // [m]
  const auto with_friction = [&](double change) {
    Body other = body;
    const auto changed = [&](const Friction& friction) {
      return Friction::from_coefficient(std::max(friction.coefficient() + change, 0.0));  // but for rounding
    };
    other.friction = changed(body.friction);
    for (FrictionChange& one : other.friction_changes) one.friction = changed(one.friction);
    return speed(other, from_start);
  };
  const auto with_drag = [&](double change) {
    Body other = body;
    other.drag_per_metre = std::max(body.drag_per_metre + change, 0.0);
    return speed(other, from_start);
  };
  // Steps end where a friction or a drag would be negative, or the track begins.
  double less_friction = std::min(kFrictionStep, body.friction.coefficient());
  for (const FrictionChange& one : body.friction_changes)
    less_friction = std::min(less_friction, one.friction.coefficient());
  const double less_drag = std::min(kDragStep, body.drag_per_metre);
  const double higher = std::min(kLengthStep, from_start);
  SpeedSlopes slopes;
  slopes.by_friction =
      (with_friction(kFrictionStep) - with_friction(-less_friction)) / (kFrictionStep + less_friction);
  slopes.by_drag = (with_drag(kDragStep) - with_drag(-less_drag)) / (kDragStep + less_drag);
  slopes.by_length =
      (speed(body, from_start - higher) - speed(body, from_start + kLengthStep)) / (higher + kLengthStep);
  return slopes;
}

}  // namespace

SpeedSlopes speed_slopes(const CenterlinePtr& track, double from_start, double place, const Body& body,
                         double gravity) {
  const bool inert = !body.law || (body.law->inertia() == 1.0 && !body.law->depends_on_speed());
  const bool linear =
      inert && body.friction_changes.empty() && (body.head_wind == 0.0 || body.drag_per_metre == 0.0);
  if (linear && body.entry_speed == 0.0) return by_quadrature(*track, from_start, place, body, gravity);
  return by_differences(track, from_start, place, body, gravity);
}

}  // namespace glissade
