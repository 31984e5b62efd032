// Gauss-Newton with halved steps to where the linearized speeds fit best among friction and drag that are not negative.

#include "glissade/trades/ski_jump/fit.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/trades/ski_jump/gates.hpp"

#include "core/counted.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace glissade {
namespace {

/// Normal equations of the two parameters; one that is held has neither row nor column.
struct Normal {
  double ff = 0.0, fd = 0.0, dd = 0.0;  // sums of products of derivatives
  double f = 0.0, d = 0.0;              // sums of derivative times excess
};

Body with(Body body, double friction, double drag) {
  body.friction = Friction::from_coefficient(friction);
  body.friction_changes.clear();
  body.drag_per_metre = drag;
  return body;
}

void require_tracks(const std::vector<SpeedReading>& readings) {
  for (const SpeedReading& reading : readings) {
    if (reading.track != nullptr) continue;
    throw InputError({reading.source, reading.name + ": the reading has no track",
                      "A speed was measured somewhere on an in-run.", "the in-run that was ridden"});
  }
}

/// @return where the speed was measured [m/s]; none where the body does not come there, or comes to rest there
std::optional<double> speed_where_measured(const SpeedReading& reading, const Body& body) {
  const Motion motion = ride_from(reading.track, reading.from_start, body, reading.gravity);
  const double way = reading.place - reading.from_start;
  if (motion.distance() < way) return {};
  const double speed = motion.at(way).speed;
  return speed > 0.0 ? std::optional<double>(speed) : std::nullopt;
}

double speed_of(const SpeedReading& reading, const Body& body) {
  const std::optional<double> speed = speed_where_measured(reading, body);
  if (speed) return *speed;
  throw InputError({reading.source,
                    reading.name + ": with a friction coefficient of " +
                        rounded_text(body.friction.coefficient(), 3) + " and a drag of " +
                        rounded_text(body.drag_per_metre, 3) +
                        " 1/m the body does not come to where its speed was measured",
                    "A speed is compared where it was measured.",
                    "less friction or drag; the place, the gate and the design ridden"});
}

/// No fit explains a speed that is far beyond free fall: it is of another unit, or of another place.
/// A wind from behind may push a body.
void require_below_free_fall(const SpeedReading& reading) {
  constexpr double kBeyond = 1.05;  // taste: what a measurement is off by at most
  const double drop = reading.track->at(reading.place).drop - reading.track->at(reading.from_start).drop;
  const Body& body = reading.body;
  const double most =
      std::sqrt(std::max(body.entry_speed * body.entry_speed + 2.0 * reading.gravity * drop, 0.0));
  if (body.head_wind < 0.0 || reading.speed <= kBeyond * most) return;
  throw InputError({reading.source,
                    reading.name + ": " + rounded_text(reading.speed, 4) +
                        " m/s is more than free fall gives, " + rounded_text(most, 4) + " m/s",
                    "Between the gate and that place the body falls by " + length_text(drop, 4) + ".",
                    "the column speed_km_h where that is the unit; the gate or the length of the ride; the "
                    "design ridden"});
}

void require_readings(const std::vector<SpeedReading>& readings, std::size_t parameters) {
  if (readings.size() < parameters) {
    const char* more = "speeds from several gates";
    throw InputError(
        {"",
         core::counted(readings.size(), "speed") + (readings.size() == 1 ? " does" : " do") + " not tell " +
             core::counted(parameters, "parameter"),
         "There are at least as many speeds as parameters.",
         parameters == 1 ? more : std::string(more) + "; or one of the two held at a known value"});
  }
  require_tracks(readings);
  for (const SpeedReading& reading : readings) {
    const bool in_place = reading.from_start >= 0.0 && reading.place > reading.from_start &&
                          reading.place <= reading.track->length();
    if (in_place && reading.speed > 0.0 && std::isfinite(reading.speed)) {
      require_below_free_fall(reading);
      continue;
    }
    throw InputError(
        {reading.source,
         reading.name + ": " +
             (in_place ? "the speed, " + rounded_text(reading.speed, 4) + " m/s, is not positive"
                       : "speed was measured " + length_text(reading.place) +
                             " from the start, the ride began at " + length_text(reading.from_start)),
         "A ride leads from its gate down to where its speed is measured, on the in-run.",
         "the length of the in-run, and what e counts to"});
  }
}

class Fit {
 public:
  Fit(const std::vector<SpeedReading>& readings, const SpeedFitOptions& options) : readings_(readings) {
    constexpr double kFirstFriction = 0.03;
    constexpr double kFirstDrag = 0.001;  // [1/m]
    friction_ = options.friction.value_or(kFirstFriction);
    drag_ = options.drag.value_or(kFirstDrag);
    fits_friction_ = !options.friction;
    fits_drag_ = !options.drag;
  }

  SpeedFit run() {
    come_everywhere();
    iterate();
    SpeedFit fit;
    fit.friction_at_bound = fits_friction_ && !(friction_ > 0.0);
    fit.drag_at_bound = fits_drag_ && !(drag_ > 0.0);
    fit.friction = friction_;
    fit.drag = drag_;
    fit.residuals = speed_residuals(readings_, friction_, drag_);
    fit.rms = rms_of(fit.residuals);
    add_uncertainties(fit);
    return fit;
  }

 private:
  [[nodiscard]] std::size_t parameters() const {
    return static_cast<std::size_t>(fits_friction_) + static_cast<std::size_t>(fits_drag_);
  }

  /// @return sum of the squares of the residuals; infinite where a body does not come to its place
  [[nodiscard]] double squares(double friction, double drag) const {
    constexpr double kBeyond = std::numeric_limits<double>::infinity();
    constexpr double kMost = 1e4;  // taste: nothing slides that far against more, as coefficient or per metre
    if (!(friction < kMost && drag < kMost)) return kBeyond;
    double sum = 0.0;
    for (const SpeedReading& reading : readings_) {
      const std::optional<double> speed = speed_where_measured(reading, with(reading.body, friction, drag));
      if (!speed) return kBeyond;
      sum += (*speed - reading.speed) * (*speed - reading.speed);
    }
    return sum;
  }

  /// Less of what is fitted until every body comes to its place; the reading that none of it helps is told by
  /// whatever rides next.
  void come_everywhere() {
    constexpr int kMostHalvings = 30;  // taste: a billionth of where it begins
    for (int i = 0; i < kMostHalvings && !std::isfinite(squares(friction_, drag_)); ++i) {
      if (fits_friction_) friction_ *= 0.5;
      if (fits_drag_) drag_ *= 0.5;
    }
  }

  [[nodiscard]] Normal normal() const {
    Normal sums;
    for (const SpeedReading& reading : readings_) {
      const Body body = with(reading.body, friction_, drag_);
      const double excess = speed_of(reading, body) - reading.speed;
      SpeedSlopes slopes =
          speed_slopes(reading.track, reading.from_start, reading.place, body, reading.gravity);
      if (!fits_friction_) slopes.by_friction = 0.0;
      if (!fits_drag_) slopes.by_drag = 0.0;
      sums.ff += slopes.by_friction * slopes.by_friction;
      sums.fd += slopes.by_friction * slopes.by_drag;
      sums.dd += slopes.by_drag * slopes.by_drag;
      sums.f += slopes.by_friction * excess;
      sums.d += slopes.by_drag * excess;
    }
    return sums;
  }

  /// Half of what the sum of squares grows by after a step, as far as speeds are linear.
  [[nodiscard]] static double growth(const Normal& sums, const std::array<double, 2>& step) {
    const auto [f, d] = step;
    return 0.5 * (sums.ff * f * f + 2.0 * sums.fd * f * d + sums.dd * d * d) + sums.f * f + sums.d * d;
  }

  /// @return the step of friction and drag: to where both fit best, or, where one would be negative there, to the best
  ///         place where one of them is none
  [[nodiscard]] std::array<double, 2> step(const Normal& sums) const {
    if (!fits_drag_) return {std::max(-sums.f / sums.ff, -friction_), 0.0};
    if (!fits_friction_) return {0.0, std::max(-sums.d / sums.dd, -drag_)};
    const double determinant = sums.ff * sums.dd - sums.fd * sums.fd;
    // Of rides of one length to one place both take the same from every speed.
    constexpr double kNothing = 1e-12;  // rounding
    if (!(determinant > kNothing * sums.ff * sums.dd)) {
      throw InputError({"", "these speeds do not tell friction and drag apart",
                        "Rides of one length to one place lose the same to either.",
                        "speeds from several gates; or one of the two held at a known value"});
    }
    const std::array<double, 2> free = {(-sums.f * sums.dd + sums.d * sums.fd) / determinant,
                                        (-sums.d * sums.ff + sums.f * sums.fd) / determinant};
    if (free[0] >= -friction_ && free[1] >= -drag_) return free;
    const std::array<double, 2> frictionless = {-friction_,
                                                std::max((-sums.d + sums.fd * friction_) / sums.dd, -drag_)};
    const std::array<double, 2> dragless = {std::max((-sums.f + sums.fd * drag_) / sums.ff, -friction_),
                                            -drag_};
    return growth(sums, frictionless) < growth(sums, dragless) ? frictionless : dragless;
  }

  [[nodiscard]] static ConvergenceError not_settled() {
    return ConvergenceError({"", "friction and drag do not settle",
                             "The speeds tell the two apart too badly.",
                             "one of the two held at a known value"});
  }

  /// @return friction and drag after as much of a step as makes nothing worse
  [[nodiscard]] std::array<double, 2> shortened(const std::array<double, 2>& wanted) const {
    constexpr double kLeastShare = 1e-6;  // taste: less is rounding
    const double before = squares(friction_, drag_);
    for (double share = 1.0; share > 0.0; share *= 0.5) {
      // A body that pushes itself is beyond the laws: rounding is not to make one. Where one does not come to its place
      // steps went too far, however short they are.
      const double friction = std::max(friction_ + share * wanted[0], 0.0);
      const double drag = std::max(drag_ + share * wanted[1], 0.0);
      const double after = squares(friction, drag);
      const bool is_shortest = share < kLeastShare && std::isfinite(after);
      if (after <= before * (1.0 + 1e-12) || is_shortest) return {friction, drag};
    }
    throw not_settled();
  }

  void iterate() {
    if (parameters() == 0) return;
    constexpr int kMostRounds = 100;
    constexpr double kSettledFriction = 1e-12;
    constexpr double kSettledDrag = 1e-14;  // [1/m]
    for (int round = 0; round < kMostRounds; ++round) {
      const auto [friction, drag] = shortened(step(normal()));
      const bool settled =
          std::fabs(friction - friction_) <= kSettledFriction && std::fabs(drag - drag_) <= kSettledDrag;
      friction_ = friction;
      drag_ = drag;
      if (settled) return;
    }
    throw not_settled();
  }

  /// Also where one is held at none: it is known no better for that, and takes from the other what it may be.
  void add_uncertainties(SpeedFit& fit) const {
    if (parameters() == 0 || readings_.size() <= parameters()) return;
    const Normal sums = normal();
    const double variance = fit.rms * fit.rms * static_cast<double>(readings_.size()) /
                            static_cast<double>(readings_.size() - parameters());
    if (parameters() == 1) {
      if (fits_friction_) fit.friction_uncertainty = std::sqrt(variance / sums.ff);
      if (fits_drag_) fit.drag_uncertainty = std::sqrt(variance / sums.dd);
      return;
    }
    const double determinant = sums.ff * sums.dd - sums.fd * sums.fd;
    fit.friction_uncertainty = std::sqrt(variance * sums.dd / determinant);
    fit.drag_uncertainty = std::sqrt(variance * sums.ff / determinant);
    fit.correlation = -sums.fd / std::sqrt(sums.ff * sums.dd);
  }

  const std::vector<SpeedReading>& readings_;
  double friction_ = 0.0;
  double drag_ = 0.0;
  bool fits_friction_ = true;
  bool fits_drag_ = true;
};

}  // namespace

std::vector<SpeedResidual> speed_residuals(const std::vector<SpeedReading>& readings) {
  require_tracks(readings);
  std::vector<SpeedResidual> residuals;
  residuals.reserve(readings.size());
  for (const SpeedReading& reading : readings) {
    const double computed = speed_of(reading, reading.body);
    residuals.push_back({computed, computed - reading.speed});
  }
  return residuals;
}

std::vector<SpeedResidual> speed_residuals(const std::vector<SpeedReading>& readings, double friction,
                                           double drag) {
  std::vector<SpeedReading> ridden = readings;
  for (SpeedReading& reading : ridden) reading.body = with(reading.body, friction, drag);
  return speed_residuals(ridden);
}

CommonResistance common_resistance(const std::vector<SpeedReading>& readings) {
  const auto common = [&](const auto& value_of) {
    std::optional<double> value;
    for (const SpeedReading& reading : readings) {
      const std::optional<double> own = value_of(reading.body);
      if (!own || (value && *value != *own)) return std::optional<double>();
      value = own;
    }
    return value;
  };
  return {common([](const Body& body) {
            const bool one = body.friction_changes.empty();
            return one ? std::optional<double>(body.friction.coefficient()) : std::nullopt;
          }),
          common([](const Body& body) { return std::optional<double>(body.drag_per_metre); }),
          std::any_of(readings.begin(), readings.end(),
                      [](const SpeedReading& reading) { return !reading.body.friction_changes.empty(); })};
}

double rms_of(const std::vector<SpeedResidual>& residuals) {
  if (residuals.empty()) return 0.0;
  double sum = 0.0;
  for (const SpeedResidual& one : residuals) sum += one.excess * one.excess;
  return std::sqrt(sum / static_cast<double>(residuals.size()));
}

SpeedFit fit_speeds(const std::vector<SpeedReading>& readings, const SpeedFitOptions& options) {
  require_readings(readings,
                   static_cast<std::size_t>(!options.friction) + static_cast<std::size_t>(!options.drag));
  return Fit(readings, options).run();
}

}  // namespace glissade
