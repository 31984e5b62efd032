// Transcribes docs/theory.md (C1) to (C13). Differences of nearly equal numbers are avoided throughout: the
// formulas are used in the half-angle, expm1 and log1p forms that section derives, so that a track that is
// all but straight loses no digits.
#include "glissade/centerline/constant_speed_curve.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/quantity.hpp"
#include "glissade/core/units.hpp"

#include "centerline/optima/endpoint_rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace {

/// How far beyond vertical an entry slope angle may lie by rounding alone [rad]: smallest_p() itself must be
/// usable.
constexpr double kVerticalRounding = 1e-12;

/// Past this many lengths 1/k the slope angle differs from delta by less than one rounding.
constexpr double kFlatAfter = 40.0;

double square(double value) {
  return value * value;
}

/// The finish in axes turned by the friction angle, (C3).
struct TurnedFinish {
  double along = 0.0;   ///< xi_1 [m]
  double across = 0.0;  ///< eta_1 [m]; positive where the mean slope is steeper than the friction angle
};

TurnedFinish turned_finish(Endpoints endpoints, double mu) {
  const double run = std::abs(endpoints.run);
  const double secant = math::hypot(1.0, mu);
  // Fused, because H - mu L cancels near the reach limit, where it decides everything.
  return {std::fma(mu, endpoints.drop, run) / secant, std::fma(-mu, run, endpoints.drop) / secant};
}

/// (C7): the angle psi at the start, from the turned angle a = k eta_1 and the length ratio b = k xi_1.
double entry_angle(double a, double b) {
  return math::atan2(math::sin(a), -math::expm1(-b) - 2.0 * square(math::sin(a / 2.0)));
}

/// (C7): psi at the finish; not psi_0 - a, which cancels where the track has flattened out.
double exit_angle(double a, double b) {
  const double decay = math::exp(-b);
  return math::atan2(decay * math::sin(a), -math::expm1(-b) + 2.0 * decay * square(math::sin(a / 2.0)));
}

/// (C8): k times the arc length between the endpoints.
double scaled_length(double a, double b) {
  const double half_turn = math::sin(a / 2.0);
  if (b < 2.0) {
    return 2.0 * math::asinh(math::hypot(math::sinh(b / 2.0), half_turn) / math::cos(a / 2.0));
  }
  // The same, with the large e^(b/2) taken out before it can overflow.
  const double root_decay = math::exp(-b / 2.0);
  const double scaled = math::hypot(-math::expm1(-b) / 2.0, root_decay * half_turn) / math::cos(a / 2.0);
  return b + 2.0 * math::log(scaled + math::hypot(scaled, root_decay));
}

void require_positive(double value, const char* name, const char* unit) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InputError(Issue{"",
                         std::string(name) + ": " + exact_text(value) + unit + " is not positive and finite",
                         "", "a value above 0"});
}

void require_friction(Friction friction) {
  if (friction.coefficient() > 0.0) return;
  throw InputError(
      Issue{"", "friction_coefficient: 0 leaves the constant-speed track undefined",
            "Without friction nothing takes the energy that a drop gives, so no speed stays constant.",
            "a friction coefficient above 0, or centerline kind fastest (the cycloid)"});
}

void require_endpoints(Endpoints endpoints) {
  if (!std::isfinite(endpoints.run) || !std::isfinite(endpoints.drop)) {
    throw InputError(Issue{"",
                           "endpoints: run " + exact_text(endpoints.run) + " m, drop " +
                               exact_text(endpoints.drop) + " m are not finite",
                           "", ""});
  }
  if (endpoints.run != 0.0) return;
  throw InputError(
      Issue{"", "run: 0 m leaves the constant-speed track undefined",
            "On a vertical track a body presses on nothing, so no friction keeps its speed constant.",
            "a run other than 0 m, or centerline kind fastest (the free fall)"});
}

std::string mean_slope_text(Endpoints endpoints) {
  return angle_text(Angle::from_radians(math::atan2(endpoints.drop, std::abs(endpoints.run)))) + " (drop " +
         length_text(endpoints.drop) + " over " + length_text(std::abs(endpoints.run)) + ")";
}

/// The P of the track between the endpoints that leaves the start at the slope angle `zeta`, from the one
/// root in (0, |psi|] of  sin(alpha - psi) + sin(psi) e^(-alpha r) = 0, docs/theory.md (C9). The root is
/// bracketed by alpha = psi, where the left side is positive, and by a small alpha, where it is negative as
/// long as `zeta` lies beyond the mean slope.
double p_of_entry_slope(Endpoints endpoints, Friction friction, double gravity, double zeta) {
  const double mu = friction.coefficient();
  const TurnedFinish finish = turned_finish(endpoints, mu);
  const double psi = std::abs(zeta - math::atan(mu));
  const double ratio = finish.along / std::abs(finish.across);
  const auto excess = [&](double alpha) {
    return math::sin(alpha) * math::cos(psi) +
           math::sin(psi) * (2.0 * square(math::sin(alpha / 2.0)) + math::expm1(-alpha * ratio));
  };
  double high = psi;
  double low = psi / 2.0;
  while (low > std::numeric_limits<double>::min() && excess(low) >= 0.0) {
    high = low;
    low /= 2.0;
  }
  double alpha = high;
  const double excess_low = excess(low);
  const double excess_high = excess(high);
  if (excess_low < 0.0 && excess_high > 0.0) {
    std::uintmax_t iterations = 200;
    const auto bracket =
        boost::math::tools::toms748_solve(excess, low, high, excess_low, excess_high,
                                          boost::math::tools::eps_tolerance<double>(52), iterations);
    alpha = (bracket.first + bracket.second) / 2.0;
  }
  return gravity * math::hypot(1.0, mu) * std::abs(finish.across) / (mu * alpha);
}

[[noreturn]] void refuse_p(double p, Endpoints endpoints, Friction friction, double gravity) {
  const double smallest = ConstantSpeedCurve::smallest_p(endpoints, friction, gravity);
  const bool convex = turned_finish(endpoints, friction.coefficient()).across < 0.0;
  throw InputError(Issue{
      "",
      "p: " + rounded_text(p, 6) + " m^2/s^2 is too small for a mean slope of " + mean_slope_text(endpoints) +
          " at a friction angle of " + angle_text(friction.angle()),
      "Below P = " + exact_text(smallest) + " m^2/s^2 the constant-speed track overhangs: it would start " +
          (convex ? "uphill, " : "") + "steeper than vertical.",
      "p at or above " + exact_text(smallest) + " m^2/s^2" +
          (convex ? "" : ", or no p for the fastest one")});
}

}  // namespace

ConstantSpeedCurve::ConstantSpeedCurve(Friction friction, double gravity, double p)
    : friction_(friction), gravity_(gravity), p_(p) {
  require_friction(friction);
  require_positive(gravity, "gravity", " m/s^2");
  require_positive(p, "p", " m^2/s^2");
  const double mu = friction.coefficient();
  delta_ = math::atan(mu);
  rate_ = gravity * math::hypot(1.0, mu) / (p * mu);
}

ConstantSpeedCurve::ConstantSpeedCurve(Endpoints endpoints, Friction friction, double gravity, double p)
    : ConstantSpeedCurve(friction, gravity, p) {
  require_endpoints(endpoints);
  endpoints_ = endpoints;  // NOLINT(cppcoreguidelines-prefer-member-initializer): the constructor delegates
  const TurnedFinish finish = turned_finish(endpoints, friction.coefficient());
  turned_total_ = rate_ * finish.across;
  if (!(std::abs(turned_total_) < std::numbers::pi)) refuse_p(p, endpoints, friction, gravity);

  const double along = rate_ * finish.along;
  psi_entry_ = entry_angle(turned_total_, along);
  psi_exit_ = exit_angle(turned_total_, along);
  length_ = scaled_length(turned_total_, along) / rate_;
  if (std::abs(psi_entry_ + delta_) > kRightAngle + kVerticalRounding)
    refuse_p(p, endpoints, friction, gravity);
}

ConstantSpeedCurve ConstantSpeedCurve::from_entry_slope(Angle entry_slope_angle, double length,
                                                        Friction friction, double gravity, double p) {
  const double zeta = entry_slope_angle.radians();
  if (!(std::abs(zeta) <= kRightAngle)) {
    throw InputError(
        Issue{"",
              "entry_slope_angle: " + quantity_beyond(zeta, Dimension::angle, {-kRightAngle, kRightAngle}) +
                  " overhangs",
              "A slope angle lies between -90 and 90 deg.", ""});
  }
  require_positive(length, "length", " m");
  ConstantSpeedCurve curve(friction, gravity, p);
  curve.psi_entry_ = zeta - curve.delta_;
  curve.length_ = length;
  curve.turned_total_ = curve.turned_angle(length);
  curve.psi_exit_ = curve.slope_angle(length) - curve.delta_;
  const CenterlinePoint finish = curve.at(length);
  curve.endpoints_ = {finish.x, finish.drop};
  return curve;
}

ConstantSpeedCurve ConstantSpeedCurve::at_speed(Endpoints endpoints, Friction friction, double gravity,
                                                double speed) {
  require_positive(speed, "speed", " m/s");
  const double p = square(speed);
  if (!(p > 0.0 && std::isfinite(p))) {
    throw InputError(Issue{"", "speed: " + exact_text(speed) + " m/s is out of range",
                           "P is its square, which is beyond the range of numbers.", "a speed in m/s"});
  }
  return {endpoints, friction, gravity, p};
}

double ConstantSpeedCurve::smallest_p(Endpoints endpoints, Friction friction, double gravity) {
  require_endpoints(endpoints);
  require_friction(friction);
  require_positive(gravity, "gravity", " m/s^2");
  const double across = turned_finish(endpoints, friction.coefficient()).across;
  if (across == 0.0) return 0.0;
  return p_of_entry_slope(endpoints, friction, gravity, std::copysign(kRightAngle, across));
}

double ConstantSpeedCurve::constant_speed() const noexcept {
  return std::sqrt(p_);
}

Angle ConstantSpeedCurve::entry_slope_angle() const noexcept {
  return Angle::from_radians(psi_entry_ + delta_);
}

Angle ConstantSpeedCurve::exit_slope_angle() const noexcept {
  return Angle::from_radians(psi_exit_ + delta_);
}

double ConstantSpeedCurve::turned_angle(double s) const {
  if (!(s >= 0.0 && s <= length_)) {
    throw InputError(Issue{
        "", "s: " + exact_text(s) + " m lies outside the track, 0 to " + exact_text(length_) + " m", "", ""});
  }
  const double cosine = math::cos(psi_entry_);
  const double decay_less_1 = math::expm1(-rate_ * s);
  return 2.0 * math::atan2(-decay_less_1 * math::sin(psi_entry_), 2.0 + (1.0 - cosine) * decay_less_1);
}

double ConstantSpeedCurve::slope_angle(double s) const {
  return delta_ + (psi_entry_ - turned_angle(s));
}

CenterlinePoint ConstantSpeedCurve::at(double s) const {
  const double turned = turned_angle(s);
  const double scaled = rate_ * s;
  const double psi =
      2.0 * math::atan2(math::sin(psi_entry_ / 2.0) * math::exp(-scaled), math::cos(psi_entry_ / 2.0));
  // (C5): both forms of k xi; the first cannot overflow, the second does not cancel where the track is short.
  const double scaled_along =
      scaled > 1.0
          ? scaled + math::log1p(square(math::sin(psi_entry_ / 2.0)) * math::expm1(-2.0 * scaled))
          : math::log1p(2.0 * square(math::sinh(scaled / 2.0)) + math::cos(psi_entry_) * math::sinh(scaled));
  const double along = scaled_along / rate_;
  const double across = turned / rate_;
  const double cosine = math::cos(delta_);
  const double sine = math::sin(delta_);
  return {.arc_length = s,
          .x = along * cosine - across * sine,
          .drop = along * sine + across * cosine,
          .slope_angle = delta_ + (psi_entry_ - turned),
          .curvature = rate_ * math::sin(psi)};
}

double ConstantSpeedCurve::arc_length_at_slope(Angle slope_angle) const {
  const double psi = slope_angle.radians() - delta_;
  const auto [low, high] = std::minmax(psi_entry_, psi_exit_);
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  if (low == high || !(psi >= low - rounding && psi <= high + rounding)) {
    throw InputError(Issue{"", "slope_angle: " + angle_text(slope_angle) + " is not met at one place",
                           "The track turns from " + angle_text(Angle::from_radians(psi_entry_ + delta_)) +
                               " to " + angle_text(Angle::from_radians(psi_exit_ + delta_)) + ".",
                           ""});
  }
  const double turn = math::sin((psi_entry_ - psi) / 2.0);
  const double mean_sine = std::sqrt(math::sin(psi_entry_) * math::sin(psi));
  return std::clamp(2.0 * math::asinh(std::abs(turn) / mean_sine) / rate_, 0.0, length_);
}

bool ConstantSpeedCurve::holds_body() const noexcept {
  return psi_entry_ + delta_ >= 0.0;
}

double ConstantSpeedCurve::lift_off_speed(double s) const {
  const double tangent = math::tan(slope_angle(s));
  const double mu = friction_.coefficient();
  if (!is_convex()) return std::numeric_limits<double>::infinity();
  // cos(zeta) g = |kappa| v with kappa from (C1): v = P mu/(mu - tan zeta), and tan zeta < mu on a crest.
  return std::sqrt(p_ * mu / (mu - tangent));
}

double ConstantSpeedCurve::speed_squared(double s, double entry_speed) const {
  const double exponent = -2.0 * friction_.coefficient() * turned_angle(s);
  return square(entry_speed) * math::exp(exponent) - p_ * math::expm1(exponent);
}

void ConstantSpeedCurve::require_motion(double s, double entry_speed) const {
  centerline::require_entry_speed(entry_speed);
  if (entry_speed == 0.0 && psi_entry_ <= 0.0) {
    throw InfeasibleError(Issue{
        "",
        "the entry slope angle, " + angle_text(Angle::from_radians(psi_entry_ + delta_)) +
            ", is not steeper than the friction angle, " + angle_text(Angle::from_radians(delta_)),
        "A body at rest never starts to slide there (docs/theory.md, reach theorem).",
        "an entry_speed of " + rounded_text(constant_speed(), 6) + " m/s, which this track keeps constant"});
  }
  if (!is_convex()) return;
  if (speed_squared(s, entry_speed) < 0.0) {
    // (C10): v = 0 where e^(-2 mu theta) = P/(P - v_0)
    const double turned = math::log1p(-square(entry_speed) / p_) / (2.0 * friction_.coefficient());
    throw InfeasibleError(Issue{
        "",
        "a body that enters at " + rounded_text(entry_speed, 6) + " m/s stalls where the slope angle is " +
            angle_text(Angle::from_radians(psi_entry_ + delta_ - turned)),
        "The mean slope is flatter than the friction angle, " + angle_text(Angle::from_radians(delta_)) + ".",
        "an entry_speed of " + rounded_text(constant_speed(), 6) + " m/s, which this track keeps constant"});
  }
  const auto require_contact = [&](double station) {
    const double here = speed_squared(station, entry_speed);
    const double mu = friction_.coefficient();
    const double zeta = slope_angle(station);
    if (here * (mu * math::cos(zeta) - math::sin(zeta)) <=
        p_ * mu * math::cos(zeta) * (1.0 + kVerticalRounding))
      return;
    throw InfeasibleError(
        Issue{"",
              "a body that enters at " + rounded_text(entry_speed, 6) + " m/s leaves the track at s = " +
                  length_text(station) + ", at " + rounded_text(std::sqrt(here), 6) + " m/s",
              "The crest holds a body there up to " + rounded_text(lift_off_speed(station), 6) + " m/s.",
              "a lower entry_speed, or a larger p, which makes the crest less curved"});
  };
  require_contact(0.0);
  require_contact(s);
  // (C13): with mu > sqrt(3) the margin can be least in between.
  const double mu = friction_.coefficient();
  if (mu * mu <= 3.0) return;
  const double zeta = math::atan((mu + std::sqrt(mu * mu - 3.0)) / 3.0);
  if (zeta > psi_entry_ + delta_ && zeta < slope_angle(s))
    require_contact(arc_length_at_slope(Angle::from_radians(zeta)));
}

double ConstantSpeedCurve::speed(double s, double entry_speed) const {
  require_motion(s, entry_speed);
  return std::sqrt(speed_squared(s, entry_speed));
}

double ConstantSpeedCurve::travel_time(double entry_speed) const {
  require_motion(length_, entry_speed);
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
  constexpr unsigned kDepth = 20;
  // Compared with the difference to the 15-point rule; the 31-point rule is right to the last digits by then.
  constexpr double kTolerance = 1e-12;

  const double entry_v = square(entry_speed);
  const double exit_v = speed_squared(length_, entry_speed);
  const double flat_after = (kFlatAfter + std::max(0.0, math::log(p_ / exit_v))) / rate_;
  const double curved_length = std::min(length_, flat_after);

  // Every integrand and interval below is made of order one, which the quadrature's tolerance counts on.
  const auto slowness = [&](double s) {
    return std::sqrt(exit_v / speed_squared(std::min(s, length_), entry_speed));
  };
  const auto panel_from_start = [&](double width) {
    // From rest u grows like sqrt(s). Take z = sqrt(v_0 + v_0' s) for s: z/u is smooth.
    const double gain =
        2.0 * friction_.coefficient() * rate_ * math::sin(psi_entry_) * (p_ - entry_v) * width;
    const double rise = gain / (std::sqrt(entry_v + gain) + entry_speed);
    const auto smooth = [&](double part) {
      const double z = entry_speed + rise * part;
      return 2.0 * z * rise / gain * slowness(rise * part * (z + entry_speed) / gain * width);
    };
    return width * Quadrature::integrate(smooth, 0.0, 1.0, kDepth, kTolerance);
  };
  const auto panel = [&](double start, double width) {
    const auto smooth = [&](double part) { return slowness(start + part * width); };
    return width * Quadrature::integrate(smooth, 0.0, 1.0, kDepth, kTolerance);
  };

  // 1/u tends to a constant like e^(-k s): panels may grow. Behind the last one it is that constant.
  double time = length_ - curved_length;
  double start = 0.0;
  for (const double edge : {1.0, 3.0, 8.0, 20.0, std::numeric_limits<double>::infinity()}) {
    const double end = std::min(edge / rate_, curved_length);
    const bool slow_start = start == 0.0 && psi_entry_ > 0.0 && entry_v < p_ / 4.0;
    time += slow_start ? panel_from_start(end) : panel(start, end - start);
    start = end;
    if (end == curved_length) break;
  }
  return time / std::sqrt(exit_v);
}

double ConstantSpeedCurve::travel_time_at_constant_speed() const noexcept {
  return length_ / constant_speed();
}

}  // namespace glissade
