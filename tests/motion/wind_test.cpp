// A wind from behind that all but balances slope and friction: the body creeps, and comes to rest or not by a hair.

#include "glissade/core/error.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/motion/stall_friction.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "tracks.hpp"

#include <cmath>
#include <limits>

namespace wind_test {

using namespace glissade;
using testing::track;

namespace {

constexpr double kGravity = kDefaultGravity;
constexpr double kFriction = 0.15;

/// On the level, where friction takes F = mu g and the wind gives k (w - u)^2, with q = sqrt(F/k).
struct Level {
  double drag = 0.02;
  double wind = 0.0;   ///< w from behind [m/s]
  double entry = 0.0;  ///< [m/s]; < w

  [[nodiscard]] double balance() const { return std::sqrt(kFriction * kGravity / drag); }
  [[nodiscard]] Body body() const {
    Body body;
    body.friction = Friction::from_coefficient(kFriction);
    body.entry_speed = entry;
    body.drag_per_metre = drag;
    body.head_wind = -wind;
    return body;
  }
};

/// @return atanh(a/q), of a < q by q - a
double atanh_of(double q, double short_of) {
  return 0.5 * std::log((2.0 * q - short_of) / short_of);
}

}  // namespace

TEST_CASE("wind: below its balance a body comes to rest where it does in closed form, however near") {
  for (const double behind : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8}) {
    for (const double share : {0.02, 0.5, 0.95}) {
      Level level;
      const double q = level.balance();
      level.wind = q / (1.0 + behind);
      level.entry = share * level.wind;
      const double short_of = q - level.wind;
      // dy/dt = F - k y^2 of y = w - u, which comes to w.
      const double time = (atanh_of(q, short_of) - atanh_of(q, short_of + level.entry)) / (level.drag * q);
      const double first = (short_of + level.entry) * (2.0 * q - short_of - level.entry);
      const double place =
          level.wind * time + std::log(short_of * (2.0 * q - short_of) / first) / (2.0 * level.drag);
      const Motion motion(track(0.0, {{1.2 * place, 0.0, 0.0}}), level.body());
      INFO(behind << " behind, from " << share << " of the wind, " << place << " m");
      REQUIRE(motion.stall());
      // What rounding makes of the balance.
      const double told = 1e-11 + 1e-14 / behind;
      CHECK(motion.stall()->arc_length == Approx(place).epsilon(told));
      CHECK(motion.travel_time() == Approx(time).epsilon(1e-9 + 10.0 * told));
      // On a track that ends there this friction is that at which the body stalls.
      if (behind < 1e-4) continue;
      const auto stalls = stall_friction_angle(track(0.0, {{place, 0.0, 0.0}}), level.body(), kGravity);
      REQUIRE(stalls);
      CHECK(stalls->degrees() ==
            Approx(Friction::from_coefficient(kFriction).angle().degrees()).margin(6e-5));
    }
  }
}

TEST_CASE("wind: above its balance a body goes on, as fast as in closed form, however slow that is") {
  for (const double ahead : {1e-1, 1e-2, 1e-3, 1e-4}) {
    for (const double share : {0.0, 0.3, 0.9}) {
      Level level;
      const double q = level.balance();
      level.wind = q * (1.0 + ahead);
      level.entry = share * level.wind;
      const double steady = level.wind - q;
      const Motion motion(track(0.0, {{12.0, 0.0, 0.0}}), level.body());
      INFO(ahead << " ahead, from " << share << " of the wind");
      REQUIRE(motion.arrived());
      // dv/ds = 2 k (u - steady) (u - steady - 2 q): s = w t + ln(...)/(2 k), by what is left to the steady speed.
      const double from = level.entry - steady;
      const double left = motion.exit_speed() - steady;
      const auto time_to = [&](double apart) {
        return std::log(std::fabs(apart) / (2.0 * q - apart)) / (-2.0 * level.drag * q);
      };
      const double time = time_to(left) - time_to(from);
      const double place = level.wind * time + std::log(std::fabs(left) * (2.0 * q - left) /
                                                        (std::fabs(from) * (2.0 * q - from))) /
                                                   (2.0 * level.drag);
      // Where next to nothing is left its logarithm has few digits.
      const double known = 1e-13 * level.wind / std::fabs(left);
      if (known < 1e-3) {
        CHECK(place == Approx(12.0).epsilon(1e-9 + known / (level.drag * 12.0)));
        CHECK(motion.travel_time() == Approx(time).epsilon(1e-9 + 10.0 * known));
      } else {
        CHECK(motion.exit_speed() == Approx(steady).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("wind: where a body all but stands for long, its ride says that the balance decides") {
  Level level;
  level.entry = 0.5;
  level.wind = level.balance() * (1.0 + 1e-7);
  CHECK_THROWS_WITH(Motion(track(0.0, {{60.0, 0.0, 0.0}}), level.body()),
                    Catch::Matchers::Contains("Wind from behind, slope and friction balance there") &&
                        Catch::Matchers::Contains("Try: a little more, or less, wind or friction"));
}

TEST_CASE(
    "wind: in a wide valley a body comes to rest just where wind, slope and friction balance, after endless "
    "time") {
  Body body;
  body.friction = Friction::from_coefficient(kFriction);
  body.entry_speed = 0.4;
  body.drag_per_metre = 0.2;
  body.head_wind = -3.5;
  // From a slope that the wind takes the body down to one that it does not: flatter by 1/600 a metre.
  const double begin = 0.02;
  const CenterlinePtr valley = track(begin, {{90.0, 1.0 / 600.0, 1.0 / 600.0}});
  const Motion motion(valley, body);
  REQUIRE(motion.stall());
  const double rest = motion.stall()->arc_length;
  const double zeta = valley->slope_angle(rest);
  CHECK(kGravity * (kFriction * std::cos(zeta) - std::sin(zeta)) == Approx(0.2 * 3.5 * 3.5).epsilon(1e-12));
  CHECK(motion.travel_time() == std::numeric_limits<double>::infinity());
  // Nothing of its energy is lost on the way that is not looked at.
  const MotionState end = motion.at(rest);
  const double gained = 0.5 * 0.4 * 0.4 + kGravity * valley->at(rest).drop;
  CHECK(end.friction_loss + end.drag_loss == Approx(gained).margin(1e-9 * end.friction_loss));
  CHECK(end.drag_loss < 0.0);
}

TEST_CASE("wind: rides near the balance keep their energy, and stall or arrive") {
  auto random = testing::seeded_random();
  for (int draw = 0; draw < 60; ++draw) {
    Body body;
    const double mu = random.between(0.02, 0.4);
    body.friction = Friction::from_coefficient(mu);
    body.entry_speed = random.integer(0, 1) == 0 ? 0.0 : random.between(0.1, 2.0);
    body.drag_per_metre = random.between(0.01, 0.2);
    const double slope = random.between(-0.15, 0.15);
    const double needed = kGravity * (mu * std::cos(slope) - std::sin(slope));
    if (!(needed > 0.0)) continue;
    body.head_wind = -std::sqrt(needed / body.drag_per_metre) * random.between(0.9, 1.2);
    const CenterlinePtr line =
        track(slope, {{random.between(1.0, 5.0), 0.0, 0.0},
                      {random.between(2.0, 15.0), 0.0, random.between(-0.02, 0.02)},
                      {random.between(2.0, 15.0), random.between(-0.02, 0.02), random.between(-0.02, 0.02)}});
    INFO("draw " << draw << ", wind " << body.head_wind << " m/s, friction " << mu);
    const Motion motion(line, body);
    CHECK((motion.arrived() || motion.stall().has_value()));
    const MotionState end = motion.at(motion.distance());
    const double energy =
        0.5 * body.entry_speed * body.entry_speed + kGravity * line->at(motion.distance()).drop;
    CHECK(0.5 * end.speed * end.speed ==
          Approx(energy - end.friction_loss - end.drag_loss).margin(1e-9 * (1.0 + end.friction_loss)));
    // Between any two places on its way, too.
    for (const double share : {0.1, 0.35, 0.8}) {
      const MotionState at = motion.at(share * motion.distance());
      if (std::isinf(at.time)) continue;
      const double there =
          0.5 * body.entry_speed * body.entry_speed + kGravity * line->at(at.arc_length).drop;
      CHECK(0.5 * at.speed * at.speed == Approx(there - at.friction_loss - at.drag_loss).margin(1e-9));
    }
  }
}

}  // namespace wind_test
