// The one-dimensional search behind ConstantSpeedCurve::fastest, over q = ln(P/P_min) so that no scale is
// special. A coarse sweep brackets the least travel time, NLopt's Nelder-Mead search (LN_NELDERMEAD) ends in
// the bracket: it needs no derivative, takes bounds, works in one dimension (LN_BOBYQA does not) and uses no
// random numbers, so the same input gives the same bits.
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <vector>

#include <nlopt.hpp>

namespace glissade {
namespace {

constexpr double kSweepStep = 0.5;
/// A track with P = e^14 P_min is straight to about one part in 10^6; the least travel time lies well below.
constexpr double kSweepEnd = 14.0;
/// Relative change of P below which the travel time, flat at its least, has no digits left to tell.
constexpr double kRelativeStep = 1e-9;
constexpr int kMostEvaluations = 500;

class TravelTimeOfP {
 public:
  TravelTimeOfP(Endpoints endpoints, Friction friction, double gravity, double entry_speed)
      : endpoints_(endpoints),
        friction_(friction),
        gravity_(gravity),
        entry_speed_(entry_speed),
        smallest_p_(ConstantSpeedCurve::smallest_p(endpoints, friction, gravity)) {}

  [[nodiscard]] double smallest_p() const { return smallest_p_; }
  [[nodiscard]] ConstantSpeedCurve curve(double q) const {
    return {endpoints_, friction_, gravity_, smallest_p_ * std::exp(q)};
  }
  [[nodiscard]] double operator()(double q) const { return curve(q).travel_time(entry_speed_); }

 private:
  Endpoints endpoints_;
  Friction friction_;
  double gravity_;
  double entry_speed_;
  double smallest_p_;
};

double minimise(const TravelTimeOfP& travel_time, double low, double start, double high) {
  nlopt::opt search(nlopt::LN_NELDERMEAD, 1);
  search.set_min_objective([](const std::vector<double>& q, std::vector<double>&,
                              void* data) { return (*static_cast<const TravelTimeOfP*>(data))(q.front()); },
                           const_cast<TravelTimeOfP*>(&travel_time));
  search.set_lower_bounds(low);
  search.set_upper_bounds(high);
  search.set_initial_step(kSweepStep / 4.0);
  search.set_xtol_abs(kRelativeStep);
  search.set_maxeval(kMostEvaluations);
  std::vector<double> q{start};
  double least = 0.0;
  std::string failure;
  try {
    const nlopt::result result = search.optimize(q, least);
    if (result != nlopt::MAXEVAL_REACHED) return q.front();
    failure = "no convergence within " + std::to_string(kMostEvaluations) + " evaluations";
  } catch (const nlopt::roundoff_limited&) {
    return q.front();
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
  const TravelTimeOfP travel_time(endpoints, friction, gravity, entry_speed);
  if (!(endpoints.drop > friction.coefficient() * std::abs(endpoints.run))) {
    throw InfeasibleError(
        Issue{"",
              "friction_angle: " + angle_text(friction.angle().radians()) +
                  " is not flatter than the mean slope from start to finish, " +
                  angle_text(std::atan2(endpoints.drop, std::abs(endpoints.run))),
              "From rest, no track between these points reaches the finish, whatever its shape "
              "(docs/theory.md, reach "
              "theorem).",
              "a lower friction angle or a larger drop; or, with an entry speed, a p of its square"});
  }
  const double end =
      kSweepEnd + std::max(0.0, std::log(entry_speed * entry_speed / travel_time.smallest_p()));
  double best = 0.0;
  double least = travel_time(0.0);
  for (double q = kSweepStep; q < end; q += kSweepStep) {
    const double time = travel_time(q);
    if (time >= least) continue;
    least = time;
    best = q;
  }
  return travel_time.curve(minimise(travel_time, std::max(0.0, best - kSweepStep), best, best + kSweepStep));
}

}  // namespace glissade
