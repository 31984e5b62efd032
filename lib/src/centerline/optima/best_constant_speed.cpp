// The one-dimensional search behind ConstantSpeedCurve::fastest, over q = ln(P/P_min) so that no scale is
// special. A coarse sweep brackets each travel time that is less than those beside it, NLopt's Nelder-Mead search
// (LN_NELDERMEAD) ends in the bracket: it needs no derivative, takes bounds, works in one dimension (LN_BOBYQA does not) and uses no
// random numbers, so the same input gives the same bits.
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <nlopt.hpp>

namespace glissade {
namespace {

constexpr double kSweepStep = 0.5;
/// P = e^36 P_min is the straight line to one rounding. From rest the least travel time lies far below; a
/// body that enters fast may do best on the straight line.
constexpr int kSweepSteps = 72;
/// Relative change of P below which the travel time, flat at its least, has no digits left to tell.
constexpr double kRelativeStep = 1e-9;
constexpr int kMostEvaluations = 500;

class TravelTimeOfP {
 public:
  TravelTimeOfP(Endpoints endpoints, Friction friction, double gravity,
                const ConstantSpeedCurve::TravelTime& time)
      : endpoints_(endpoints),
        friction_(friction),
        gravity_(gravity),
        time_(time),
        smallest_p_(ConstantSpeedCurve::smallest_p(endpoints, friction, gravity)) {}

  [[nodiscard]] ConstantSpeedCurve curve(double q) const {
    return {endpoints_, friction_, gravity_, smallest_p_ * math::exp(q)};
  }
  [[nodiscard]] double operator()(double q) const { return time_(curve(q)); }

 private:
  Endpoints endpoints_;
  Friction friction_;
  double gravity_;
  const ConstantSpeedCurve::TravelTime& time_;
  double smallest_p_;
};

/// low < inside < high, with the travel time less inside than at either end.
struct Bracket {
  double low = 0.0;
  double inside = 0.0;
  double high = 0.0;
};

/// A body on a long, flat track does best close to P_min, where a step must be small to see it. A Nelder-Mead
/// search that starts on a bound stays there, so the bracket must hold a point inside.
constexpr double kSmallestStep = 1e-9;

Bracket beside_smallest(const TravelTimeOfP& travel_time, double time_at_smallest) {
  double inside = kSweepStep / 2.0;
  while (inside > kSmallestStep && travel_time(inside) >= time_at_smallest) inside /= 2.0;
  return {0.0, inside, 2.0 * inside};
}

/// Around every step of the sweep that is faster than those beside it, by more than rounding but for the fastest of all, which
/// comes first. None where a body arrives at no step.
std::vector<Bracket> sweep(const TravelTimeOfP& travel_time) {
  constexpr double kRounding =
      1e-9;  // rounding: above that of any travel time, of the flat times towards the straight line
  std::vector<double> times;
  for (int step = 0; step <= kSweepSteps; ++step) times.push_back(travel_time(step * kSweepStep));
  const auto best = static_cast<int>(std::min_element(times.begin(), times.end()) - times.begin());
  const auto time = [&](int step) { return times[static_cast<std::size_t>(step)]; };
  if (!std::isfinite(time(best))) return {};
  const auto around = [&](int step) {
    const double q = step * kSweepStep;
    return step == 0 ? beside_smallest(travel_time, time(0)) : Bracket{q - kSweepStep, q, q + kSweepStep};
  };
  std::vector<Bracket> brackets{around(best)};
  for (int step = 0; step < kSweepSteps; ++step) {
    if (step == best) continue;
    const double deeper = time(step) * (1.0 + kRounding);
    if ((step == 0 || deeper < time(step - 1)) && deeper < time(step + 1)) brackets.push_back(around(step));
  }
  return brackets;
}

/// Where a search ended [q], and the travel time there [s].
struct Least {
  double q = 0.0;
  double time = 0.0;
};

Least minimise(const TravelTimeOfP& travel_time, Bracket bracket) {
  nlopt::opt search(nlopt::LN_NELDERMEAD, 1);
  search.set_min_objective([](const std::vector<double>& q, std::vector<double>&,
                              void* data) { return (*static_cast<const TravelTimeOfP*>(data))(q.front()); },
                           const_cast<TravelTimeOfP*>(&travel_time));
  search.set_lower_bounds(bracket.low);
  search.set_upper_bounds(bracket.high);
  search.set_initial_step((bracket.high - bracket.low) / 8.0);
  search.set_xtol_abs(kRelativeStep);
  search.set_maxeval(kMostEvaluations);
  std::vector<double> q{bracket.inside};
  double least = 0.0;
  std::string failure;
  try {
    const nlopt::result result = search.optimize(q, least);
    if (result != nlopt::MAXEVAL_REACHED) return {q.front(), least};
    failure = "no convergence within " + std::to_string(kMostEvaluations) + " evaluations";
  } catch (const nlopt::roundoff_limited&) {
    return {q.front(), least};
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    failure = error.what();
  }
  throw ConvergenceError(
      Issue{"", "the search for the fastest constant-speed track gave up: " + failure,
            "It had come to P = " + rounded_text(travel_time.curve(q.front()).p(), 6) + " m^2/s^2.",
            "a p of your own"});
}

}  // namespace

ConstantSpeedCurve ConstantSpeedCurve::fastest(Endpoints endpoints, Friction friction, double gravity,
                                               double entry_speed) {
  return fastest(endpoints, friction, gravity,
                 [entry_speed](const ConstantSpeedCurve& curve) { return curve.travel_time(entry_speed); });
}

ConstantSpeedCurve ConstantSpeedCurve::fastest(Endpoints endpoints, Friction friction, double gravity,
                                               const TravelTime& time) {
  const TravelTimeOfP travel_time(endpoints, friction, gravity, time);
  if (!(endpoints.drop > friction.coefficient() * std::abs(endpoints.run))) {
    throw InfeasibleError(
        Issue{"",
              "friction_angle: " + angle_text(friction.angle()) +
                  " is not flatter than the mean slope from start to finish, " +
                  angle_text(Angle::from_radians(math::atan2(endpoints.drop, std::abs(endpoints.run)))),
              "From rest, no track between these points reaches the finish, whatever its shape "
              "(docs/theory.md, reach "
              "theorem).",
              "a lower friction angle or a larger drop; or, with an entry speed, a p of its square"});
  }
  std::optional<Least> least;
  for (const Bracket& bracket : sweep(travel_time)) {
    const Least here = minimise(travel_time, bracket);
    if (!least || here.time < least->time) least = here;
  }
  if (!least) {
    throw InfeasibleError(
        Issue{"", "constant-speed: the body arrives on none of these tracks, whatever their p",
              "It stalls on each, up to the straight line.", "kind: fastest, or less drag"});
  }
  return travel_time.curve(least->q);
}

}  // namespace glissade
