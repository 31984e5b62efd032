// Take-off speed grows with the straight above the transition: each shape is found by bracketing that length.

#include "glissade/trades/ski_jump/redesign.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace {

constexpr double kLongestStraight = 1e5;  // [m]
constexpr int kBits = 44;                 // of a length that is bracketed

/// Exit speed of a ride; 0 where the body does not arrive, which a longer straight would mend.
double exit_speed(CenterlinePtr track, const TakeOff& take_off) {
  const Motion motion(std::move(track), take_off.body, take_off.gravity);
  return motion.arrived() ? motion.exit_speed() : 0.0;
}

std::string speed_words(double speed) {
  return rounded_text(speed, 5) + " m/s";
}

[[noreturn]] void refuse_too_slow(const TakeOff& take_off) {
  throw InfeasibleError({"take-off speed",
                         "take-off speed: " + speed_words(take_off.speed) +
                             " is out of reach of this body, however high the start is",
                         "Friction and drag take all that the slope gives.",
                         "a steeper straight, less friction or drag, or a lower speed"});
}

/// A root of a function that grows, between two places where its sign differs.
double root_between(const std::function<double(double)>& excess, double low, double high) {
  std::uintmax_t most = 60;
  const auto [left, right] = boost::math::tools::toms748_solve(
      excess, low, high, boost::math::tools::eps_tolerance<double>(kBits), most);
  return std::fabs(excess(left)) < std::fabs(excess(right)) ? left : right;
}

/// The straight at which a take-off speed is reached.
/// @param speed  at the edge with a straight of this length [m]
double straight_for(const TakeOff& take_off, const std::function<double(double)>& speed) {
  if (!(take_off.speed > 0.0 && std::isfinite(take_off.speed))) {
    throw InputError({"take-off speed",
                      "take-off speed: " + exact_text(take_off.speed) + " m/s is not a finite speed above 0",
                      "It is what the straight is as long as.", "25 m/s for a large hill"});
  }
  const auto excess = [&](double straight) { return speed(straight) - take_off.speed; };
  constexpr double kShortest = 1e-9;  // [m]
  if (excess(kShortest) > 0.0) {
    throw InfeasibleError(
        {"take-off speed",
         "take-off speed: " + speed_words(take_off.speed) + " is less than the transition alone gives",
         "Even a start at E1 is too high.", "a smaller r1, or a higher speed"});
  }
  double high = 16.0;
  while (excess(high) < 0.0) {
    high *= 2.0;
    if (high > kLongestStraight) refuse_too_slow(take_off);
  }
  return root_between(excess, kShortest, high);
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
  const double straight = straight_for(take_off, [&](double length) {
    return exit_speed(std::make_shared<const InRun>(with(length)), take_off);
  });
  return with(straight);
}

DropSlopes drop_slopes(const InRunShape& shape, const TakeOff& take_off) {
  const auto slope = [&](double step, const std::function<void(InRunShape&, TakeOff&, double)>& change) {
    const auto drop = [&](double by) {
      InRunShape other = shape;
      TakeOff wanted = take_off;
      change(other, wanted, by);
      return drop_of(reaching(other, wanted));
    };
    return (drop(step) - drop(-step)) / (2.0 * step);
  };
  constexpr double kAngle = 1e-4;   // [rad]
  constexpr double kLength = 1e-2;  // [m]
  constexpr double kSpeed = 1e-3;   // [m/s]
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

/// A letter of an in-run that may change, with the sides that it keeps to.
struct FreeLetter {
  double lowest;
  double highest;
  std::function<double(const InRunShape&)> value;
  std::function<void(InRunShape&, double)> set;
};

FreeLetter free_letter(const Range& bound, double now, std::function<double(const InRunShape&)> value,
                       std::function<void(InRunShape&, double)> set) {
  FreeLetter letter{bound.lowest.value_or(now), bound.highest.value_or(now), std::move(value),
                    std::move(set)};
  if (bound.lowest && !bound.highest) letter.highest = std::max(now, letter.lowest);
  if (bound.highest && !bound.lowest) letter.lowest = std::min(now, letter.highest);
  if (!(letter.lowest <= letter.highest)) {
    throw InputError({"bounds",
                      "a letter's lowest bound, " + exact_text(letter.lowest) + ", is above its highest, " +
                          exact_text(letter.highest),
                      "Nothing lies between them.", ""});
  }
  return letter;
}

std::vector<FreeLetter> free_letters(const InRunShape& shape, const LetterBounds& bounds) {
  return {free_letter(
              bounds.gamma, shape.gamma.radians(), [](const InRunShape& of) { return of.gamma.radians(); },
              [](InRunShape& of, double value) { of.gamma = Angle::from_radians(value); }),
          free_letter(
              bounds.r1, shape.r1, [](const InRunShape& of) { return of.r1; },
              [](InRunShape& of, double value) { of.r1 = value; }),
          free_letter(
              bounds.t, shape.t, [](const InRunShape& of) { return of.t; },
              [](InRunShape& of, double value) { of.t = value; })};
}

/// The value of a letter with the least drop: an end of its range, or where the drop is least between them.
double best_value(const InRunShape& shape, const FreeLetter& letter, const TakeOff& take_off) {
  const auto drop = [&](double value) {
    InRunShape other = shape;
    letter.set(other, value);
    return drop_of(reaching(other, take_off));
  };
  double best = letter.lowest;
  double least = drop(best);
  const auto see = [&](double value) {
    const double there = drop(value);
    if (there < least) {
      best = value;
      least = there;
    }
  };
  if (letter.lowest == letter.highest) return best;
  see(letter.highest);
  constexpr int kMinimumBits = 20;
  std::uintmax_t most = 30;
  see(boost::math::tools::brent_find_minima(drop, letter.lowest, letter.highest, kMinimumBits, most).first);
  return best;
}

}  // namespace

InRunShape least_drop_in_run(const InRunShape& shape, const LetterBounds& bounds, const TakeOff& take_off) {
  const std::vector<FreeLetter> letters = free_letters(shape, bounds);
  InRunShape best = shape;
  for (const FreeLetter& letter : letters) {
    letter.set(best, std::clamp(letter.value(best), letter.lowest, letter.highest));
  }
  best = reaching(best, take_off);
  constexpr int kMostRounds = 8;
  constexpr double kGain = 1e-9;  // [m]
  for (int round = 0; round < kMostRounds; ++round) {
    const double before = drop_of(best);
    for (const FreeLetter& letter : letters) letter.set(best, best_value(best, letter, take_off));
    best = reaching(best, take_off);
    if (before - drop_of(best) < kGain) break;
  }
  return best;
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
  const double straight = straight_for(take_off, [&](double length) {
    return exit_speed(std::make_shared<const ClothoidSpline>(with_bend(shape, length, bend(length))),
                      take_off);
  });
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

/// Slope angle and squared speed along a bend whose v^2/radius is prescribed.
class LoadBend {
 public:
  LoadBend(const InRunShape& shape, double radial_load, const TakeOff& take_off)
      : gamma_(shape.gamma.radians()),
        turn_(shape.gamma.radians() - shape.alpha.radians()),
        radial_(radial_load),
        mu_(take_off.body.friction.coefficient()),
        drag_(take_off.body.drag_per_metre),
        gravity_(take_off.gravity) {}

  /// @param v  squared speed at E1
  [[nodiscard]] std::vector<ClothoidSegment> below(double v) const {
    const auto missing = [&](double length) { return turned(length, v, nullptr) - turn_; };
    double high = 10.0;
    while (missing(high) < 0.0 && high < kLongestStraight) high *= 2.0;
    constexpr double kShortestBend = 1e-6;  // [m] taste: no bend of a hill
    if (!(missing(kShortestBend) < 0.0 && missing(high) >= 0.0)) refuse_load(v);
    std::vector<ClothoidSegment> pieces;
    static_cast<void>(turned(root_between(missing, kShortestBend, high), v, &pieces));
    return pieces;
  }

 private:
  [[noreturn]] void refuse_load(double v) const {
    throw InputError({"radial_load",
                      "radial_load: " + exact_text(radial_) + " m/s^2 gives no bend for a body with " +
                          speed_words(std::sqrt(v)) + " where it begins",
                      "The bend is shorter than 0.001 mm, or the body comes to a stand in it.",
                      "7.14 m/s^2"});
  }
  static double load_at(double share) {
    constexpr double kRamp = 0.25;
    return std::min({share / kRamp, 1.0, (1.0 - share) / kRamp});
  }
  /// d(squared speed)/ds
  [[nodiscard]] double growth(double zeta, double v, double radial) const {
    return 2.0 * (gravity_ * (math::sin(zeta) - mu_ * math::cos(zeta)) - mu_ * radial - drag_ * v);
  }

  /// The angle by which a bend of this length turns, by the classical Runge-Kutta method.
  double turned(double length, double v, std::vector<ClothoidSegment>* pieces) const {
    constexpr int kPieces = 200;
    const double ds = length / kPieces;
    double zeta = gamma_;
    for (int i = 0; i < kPieces; ++i) {
      const double share = static_cast<double>(i) / kPieces;
      const auto rate = [&](double at, double angle, double squared) {
        const double radial = radial_ * load_at(share + at / kPieces);
        return std::pair(-radial / squared, growth(angle, squared, radial));
      };
      const auto [z1, v1] = rate(0.0, zeta, v);
      const auto [z2, v2] = rate(0.5, zeta + 0.5 * ds * z1, v + 0.5 * ds * v1);
      const auto [z3, v3] = rate(0.5, zeta + 0.5 * ds * z2, v + 0.5 * ds * v2);
      const auto [z4, v4] = rate(1.0, zeta + ds * z3, v + ds * v3);
      const double begin = -z1;
      zeta += ds / 6.0 * (z1 + 2.0 * z2 + 2.0 * z3 + z4);
      v += ds / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
      const double end = radial_ * load_at(static_cast<double>(i + 1) / kPieces) / v;
      if (pieces != nullptr) pieces->push_back({ds, begin, end});
    }
    return gamma_ - zeta;
  }

  double gamma_;
  double turn_;
  double radial_;
  double mu_;
  double drag_;
  double gravity_;
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
  const LoadBend bend(shape, radial_load, take_off);
  const auto straight_of = [&](double length) {
    return std::make_shared<const ClothoidSpline>(shape.gamma,
                                                  std::vector<ClothoidSegment>{{length, 0.0, 0.0}});
  };
  // A body at E1 that hardly moves would have to turn on the spot.
  constexpr double kLeast = 1.0;  // [m]
  return reaching_with(shape, take_off, [&](double straight) {
    const double speed = exit_speed(straight_of(std::max(straight, kLeast)), take_off);
    return bend.below(std::max(speed * speed, 1.0));
  });
}

}  // namespace glissade
