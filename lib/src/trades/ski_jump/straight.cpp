// Take-off speed grows with the straight above the transition: each shape is found by bracketing that length.

#include "trades/ski_jump/straight.hpp"

#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade::trades {
namespace {

constexpr double kLongestStraight = 1e5;  // taste: no hill is as long [m]
constexpr int kBits = 44;                 // accuracy: of a length that is bracketed

std::string speed_words(const TakeOff& take_off) {
  return "take-off speed: " + rounded_text(take_off.speed, 5) + " m/s";
}

}  // namespace

double exit_speed(CenterlinePtr track, const TakeOff& take_off) {
  const Motion motion(std::move(track), take_off.body, take_off.gravity);
  return motion.arrived() ? motion.exit_speed() : 0.0;
}

double root_between(const std::function<double(double)>& excess, double low, double high) {
  std::uintmax_t most = 60;
  const auto [left, right] = boost::math::tools::toms748_solve(
      excess, low, high, boost::math::tools::eps_tolerance<double>(kBits), most);
  return std::fabs(excess(left)) < std::fabs(excess(right)) ? left : right;
}

Straight straight_for(const TakeOff& take_off, const std::function<double(double)>& speed, double shortest) {
  if (!(take_off.speed > 0.0 && std::isfinite(take_off.speed))) {
    throw InputError({"take-off speed",
                      "take-off speed: " + exact_text(take_off.speed) + " m/s is not a finite speed above 0",
                      "It is what the straight is as long as.", "25 m/s for a large hill"});
  }
  const auto excess = [&](double straight) { return speed(straight) - take_off.speed; };
  if (excess(shortest) > 0.0) return {Reach::too_fast, 0.0};
  double high = std::max(16.0, 2.0 * shortest);
  while (excess(high) < 0.0) {
    high *= 2.0;
    if (high > kLongestStraight) return {Reach::too_slow, 0.0};
  }
  return {Reach::reached, root_between(excess, shortest, high)};
}

double required(const Straight& straight, const TakeOff& take_off) {
  if (straight.reach == Reach::too_fast) {
    throw InfeasibleError({"take-off speed",
                           speed_words(take_off) + " is less than the transition alone gives",
                           "Even a start at E1 is too high.", "a smaller r1, or a higher speed"});
  }
  if (straight.reach != Reach::reached) {
    throw InfeasibleError({"take-off speed",
                           speed_words(take_off) + " is out of reach of this body, however high the start is",
                           "Friction and drag take all that the slope gives.",
                           "a steeper straight, less friction or drag, or a lower speed"});
  }
  return straight.length;
}

}  // namespace glissade::trades
