// In-runs of other shapes, each with the straight that gives the take-off speed.

#include "glissade/trades/ski_jump/redesign.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include "trades/ski_jump/straight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>

namespace glissade {

using namespace trades;

namespace {

std::string speed_words(double speed) {
  return rounded_text(speed, 5) + " m/s";
}

double drop_of(const InRunShape& shape) {
  return InRun(shape).endpoints().drop;
}

}  // namespace

InRunShape reaching(InRunShape shape, const TakeOff& take_off) {
  const double below = transition_length(shape) + shape.t;
  const auto with = [&](double straight) {
    InRunShape longer = shape;
    longer.length = below + straight;
    return longer;
  };
  const Straight straight = straight_for(take_off, [&](double length) {
    return exit_speed(std::make_shared<const InRun>(with(length)), take_off);
  });
  return with(required(straight, take_off));
}

namespace {

/// A change of letters or of the take-off speed by a step.
using Change = std::function<void(InRunShape&, TakeOff&, double)>;

/// d(drop)/d(step). By central differences; where on one side no straight gives the take-off speed by those of the other.
double slope_by(const InRunShape& shape, const TakeOff& take_off, double step, const Change& change) {
  const auto drop = [&](double by) {
    InRunShape other = shape;
    TakeOff wanted = take_off;
    change(other, wanted, by);
    return drop_of(reaching(other, wanted));
  };
  const auto drop_if_any = [&](double by) -> std::optional<double> {
    try {
      return drop(by);
    } catch (const InfeasibleError&) {
      return {};
    } catch (const InputError&) {  // letters that make no in-run
      return {};
    }
  };
  const std::optional<double> above = drop_if_any(step);
  const std::optional<double> below = drop_if_any(-step);
  if (above && below) return (*above - *below) / (2.0 * step);
  if (!above && !below) return drop(step);  // says what is in the way
  const double side = above ? step : -step;
  return (4.0 * (above ? *above : *below) - 3.0 * drop(0.0) - drop(2.0 * side)) / (2.0 * side);
}

}  // namespace

DropSlopes drop_slopes(const InRunShape& shape, const TakeOff& take_off) {
  const auto slope = [&](double step, const Change& change) {
    return slope_by(shape, take_off, step, change);
  };
  constexpr double kAngle = 1e-4;   // accuracy: [rad]
  constexpr double kLength = 1e-2;  // accuracy: [m]
  constexpr double kSpeed = 1e-3;   // accuracy: [m/s]
  DropSlopes slopes;
  slopes.by_gamma = slope(kAngle, [](InRunShape& of, TakeOff& /*to*/, double by) {
    of.gamma = Angle::from_radians(of.gamma.radians() + by);
  });
  slopes.by_alpha = slope(kAngle, [](InRunShape& of, TakeOff& /*to*/, double by) {
    of.alpha = Angle::from_radians(of.alpha.radians() + by);
  });
  slopes.by_r1 = slope(kLength, [](InRunShape& of, TakeOff& /*to*/, double by) { of.r1 += by; });
  slopes.by_t = slope(kLength, [](InRunShape& of, TakeOff& /*to*/, double by) { of.t += by; });
  slopes.by_speed = slope(kSpeed, [](InRunShape& /*of*/, TakeOff& to, double by) { to.speed += by; });
  return slopes;
}

namespace {

/// A straight, a bend of linear pieces that turns by gamma - alpha to rounding, and a table.
ClothoidSpline with_bend(const InRunShape& shape, double straight, std::vector<ClothoidSegment> bend) {
  double turned = 0.0;
  for (const ClothoidSegment& piece : bend) {
    turned += 0.5 * piece.length * (piece.entry_curvature + piece.exit_curvature);
  }
  const double scale = (shape.gamma.radians() - shape.alpha.radians()) / turned;
  std::vector<ClothoidSegment> segments = {{straight, 0.0, 0.0}};
  for (const ClothoidSegment& piece : bend) {
    segments.push_back({piece.length, scale * piece.entry_curvature, scale * piece.exit_curvature});
  }
  segments.push_back({shape.t, 0.0, 0.0});
  return ClothoidSpline(shape.gamma, std::move(segments));
}

/// @param bend  the pieces of the bend below a straight of this length
ClothoidSpline reaching_with(const InRunShape& shape, const TakeOff& take_off,
                             const std::function<std::vector<ClothoidSegment>(double)>& bend) {
  const auto speed = [&](double length) {
    return exit_speed(std::make_shared<const ClothoidSpline>(with_bend(shape, length, bend(length))),
                      take_off);
  };
  const double straight = required(straight_for(take_off, speed), take_off);
  return with_bend(shape, straight, bend(straight));
}

std::vector<ClothoidSegment> power_bend(const InRunShape& shape) {
  const double turn = shape.gamma.radians() - shape.alpha.radians();
  const double tangent = math::tan(turn);
  const double exponent = 1.0 + 1.0 / math::cos(turn);
  const double reach = shape.r1 * math::sin(turn);
  const auto slope = [&](double share) { return tangent * math::pow(share, exponent - 1.0); };
  const auto curvature = [&](double share) {
    const double stretch = 1.0 + slope(share) * slope(share);
    return (exponent - 1.0) * tangent / reach * math::pow(share, exponent - 2.0) /
           (stretch * std::sqrt(stretch));
  };
  const auto speed = [&](double share) { return reach * std::sqrt(1.0 + slope(share) * slope(share)); };
  // Crowded towards E1, where the curvature leaves 0 as a low power.
  constexpr int kPieces = 400;
  constexpr int kGrading = 4;
  std::vector<ClothoidSegment> pieces;
  double before = 0.0;
  for (int i = 1; i <= kPieces; ++i) {
    const double part = static_cast<double>(i) / kPieces;
    double share = 1.0;
    for (int k = 0; k < kGrading; ++k) share *= part;
    const double length = boost::math::quadrature::gauss<double, 10>::integrate(speed, before, share);
    pieces.push_back({length, before == 0.0 ? 0.0 : curvature(before), curvature(share)});
    before = share;
  }
  return pieces;
}

/// Slope angle and squared speed along a bend on which kappa v/(1 - kappa h) is prescribed: what curvature adds to the load
/// (docs/theory.md, laws of motion).
class LoadBend {
 public:
  /// @param straight  above the bend [m]
  /// @param v         squared speed at E1
  LoadBend(const InRunShape& shape, double radial_load, const TakeOff& take_off, double straight, double v)
      : gamma_(shape.gamma.radians()),
        turn_(shape.gamma.radians() - shape.alpha.radians()),
        radial_(radial_load),
        straight_(straight),
        v_(v),
        body_(take_off.body),
        gravity_(take_off.gravity),
        height_(body_.law ? body_.law->centre_height() : 0.0),
        gain_(2.0 / (body_.law ? body_.law->inertia() : 1.0)) {}

  [[nodiscard]] std::vector<ClothoidSegment> pieces() const {
    const auto missing = [&](double length) { return turned(length, nullptr) - turn_; };
    constexpr double kLongestBend = 1e5;  // taste: no hill is as long [m]
    double high = 10.0;
    while (missing(high) < 0.0 && high < kLongestBend) high *= 2.0;
    constexpr double kShortestBend = 1e-6;  // [m] taste: no bend of a hill
    if (!(missing(kShortestBend) < 0.0 && missing(high) >= 0.0)) refuse_load();
    std::vector<ClothoidSegment> pieces;
    static_cast<void>(turned(root_between(missing, kShortestBend, high), &pieces));
    return pieces;
  }

 private:
  [[noreturn]] void refuse_load() const {
    throw InputError({"radial_load",
                      "radial_load: " + exact_text(radial_) + " m/s^2 gives no bend for a body with " +
                          speed_words(std::sqrt(v_)) + " where it begins",
                      "The bend is shorter than 0.001 mm, or the body comes to a stand in it.",
                      "7.14 m/s^2"});
  }
  static double load_at(double share) {
    constexpr double kRamp = 0.25;
    return std::min({share / kRamp, 1.0, (1.0 - share) / kRamp});
  }
  [[nodiscard]] double curvature(double v, double radial) const { return radial / (v + radial * height_); }

  /// d(squared speed)/ds
  [[nodiscard]] double growth(double s, double zeta, double v, double radial) const {
    double mu = body_.friction.coefficient();
    for (const FrictionChange& change : body_.friction_changes) {
      if (s >= change.from) mu = change.friction.coefficient();
    }
    const double c = body_.law ? mu * body_.law->resistance(s, v).factor : mu;
    const double air =
        std::sqrt(std::max(v, 0.0)) + body_.head_wind;  // none of a trial that comes to a stand
    const double drag = body_.drag_per_metre * air * std::fabs(air);
    const double load = gravity_ * math::cos(zeta) + radial;
    return gain_ * (1.0 - curvature(v, radial) * height_) * (gravity_ * math::sin(zeta) - drag - c * load);
  }

  /// The angle by which a bend of this length turns, by the classical Runge-Kutta method.
  double turned(double length, std::vector<ClothoidSegment>* pieces) const {
    constexpr int kPieces = 200;
    const double ds = length / kPieces;
    double zeta = gamma_;
    double v = v_;
    for (int i = 0; i < kPieces; ++i) {
      const auto rate = [&](double at, double angle, double squared) {
        const double share = (static_cast<double>(i) + at) / kPieces;
        const double radial = radial_ * load_at(share);
        return std::pair(-curvature(squared, radial),
                         growth(straight_ + share * length, angle, squared, radial));
      };
      const auto [z1, v1] = rate(0.0, zeta, v);
      const auto [z2, v2] = rate(0.5, zeta + 0.5 * ds * z1, v + 0.5 * ds * v1);
      const auto [z3, v3] = rate(0.5, zeta + 0.5 * ds * z2, v + 0.5 * ds * v2);
      const auto [z4, v4] = rate(1.0, zeta + ds * z3, v + ds * v3);
      zeta += ds / 6.0 * (z1 + 2.0 * z2 + 2.0 * z3 + z4);
      v += ds / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
      const double end = curvature(v, radial_ * load_at(static_cast<double>(i + 1) / kPieces));
      if (pieces != nullptr) pieces->push_back({ds, -z1, end});
    }
    return gamma_ - zeta;
  }

  double gamma_;
  double turn_;
  double radial_;
  double straight_;
  double v_;
  const Body& body_;
  double gravity_;
  double height_;
  double gain_;
};

}  // namespace

ClothoidSpline power_in_run(const InRunShape& shape, const TakeOff& take_off) {
  const std::vector<ClothoidSegment> bend = power_bend(shape);
  return reaching_with(shape, take_off, [&](double /*straight*/) { return bend; });
}

ClothoidSpline load_controlled_in_run(const InRunShape& shape, double radial_load, const TakeOff& take_off) {
  if (!(radial_load > 0.0 && std::isfinite(radial_load))) {
    throw InputError({"", "radial_load: " + exact_text(radial_load) + " m/s^2 is not positive and finite",
                      "It is what the bend presses a jumper down with.", "7.14 m/s^2"});
  }
  const auto straight_of = [&](double length) {
    return std::make_shared<const ClothoidSpline>(shape.gamma,
                                                  std::vector<ClothoidSegment>{{length, 0.0, 0.0}});
  };
  // A body at E1 that hardly moves would have to turn on the spot.
  constexpr double kLeast = 1.0;  // [m]
  return reaching_with(shape, take_off, [&](double straight) {
    const double speed = exit_speed(straight_of(std::max(straight, kLeast)), take_off);
    return LoadBend(shape, radial_load, take_off, straight, std::max(speed * speed, 1.0)).pieces();
  });
}

}  // namespace glissade
