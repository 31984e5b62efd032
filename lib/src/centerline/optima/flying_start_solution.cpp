// The fastest track with an entry speed, docs/theory.md (V1) to (V7). In units of v0 and v0^2/g a track is two
// numbers: its exit slope t1 and the slope t_j at which the flight ends; the entry slope follows from the
// junction condition (V5), a quadratic. Over t_j at a fixed t1 the run grows from that of a pure flight; at a
// fixed run the drop grows with t1 from the reach limit (R6) to a pure flight. Both roots are bracketed.
//
// What the roots miss by rounding, the travel time does not, (V6).
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/flying_start_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/core/math.hpp"
#include "glissade/core/number_text.hpp"
#include "glissade/core/units.hpp"

#include "centerline/optima/endpoint_rules.hpp"
#include "centerline/optima/flying_start_moments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <boost/math/tools/toms748_solve.hpp>

namespace glissade {
namespace centerline {
namespace {

/// A finish in units of v0^2/g, with all that depends on friction and run alone.
struct Task {
  double mu = 0.0;
  double run = 0.0;          // X
  double drop = 0.0;         // Y
  double least_drop = 0.0;   // of the reach theorem at X
  double least_slope = 0.0;  // t1 of the reach limit at X
  double most_slope = 0.0;   // t1 of the pure flight that ends at X turned by delta
  double flight_drop = 0.0;  // Y of that flight
};

/// The flight before a junction at slope t_j.
struct Flight {
  double turn = 0.0;         // d = t_j - t0, (V5)
  double turn_rate = 0.0;    // by t_j
  double entry_slope = 0.0;  // t0
  double speed2 = 0.0;       // c^2 = cos^2(zeta_0)
};

Flight flight_to(double mu, double exit_slope, double junction) {
  const double b = 1.0 + mu * exit_slope;
  const double half = 0.5 * mu * (junction * (junction - 2.0 * exit_slope) - 1.0);
  const double length = junction - exit_slope;
  const double norm = 1.0 + junction * junction;
  const double root = std::sqrt(half * half + b * mu * length * norm);
  Flight flight;
  // Of two equal forms of the positive root the one that does not cancel.
  flight.turn = half > 0.0 ? mu * length * norm / (half + root) : (root - half) / b;
  if (root > 0.0) {
    const double constant_rate = mu * (norm + 2.0 * length * junction);
    flight.turn_rate = 0.5 * (constant_rate - 2.0 * mu * length * flight.turn) / root;
  }
  flight.entry_slope = junction - flight.turn;
  flight.speed2 = 1.0 / (1.0 + flight.entry_slope * flight.entry_slope);
  return flight;
}

/// One track of the family, in units of v0 and v0^2/g.
struct Candidate {
  double exit_slope = 0.0;
  SlopeEnd junction;
  Flight flight;
  double run = 0.0;
  double drop = 0.0;
  double time = 0.0;
  double run_rate = 0.0;  // by the opening, see junction_at()
  double drop_rate = 0.0;
};

/// A junction beyond the exit slope, by an opening in [0, infinity) that spreads out both of its limits: t_j
/// growing without bound, or towards the slope at which E vanishes.
struct Opened {
  SlopeEnd junction;
  double rate = 0.0;  // d(t_j)/d(opening)
};

Opened junction_at(double mu, double q2, double exit_slope, double opening) {
  if (q2 > 0.0) {
    const double slope = math::sinh(math::asinh(exit_slope) + opening);
    const double tau = slope - mu;
    return {{slope, tau * tau + q2}, std::sqrt(1.0 + slope * slope)};
  }
  const double root = std::sqrt(-q2);
  const double left = (mu - root - exit_slope) * math::exp(-opening);
  return {{mu - root - left, left * (left + 2.0 * root)}, left};
}

Candidate candidate_at(double mu, double exit_slope, double opening) {
  const double q2 = 1.0 - mu * mu + 2.0 * mu * exit_slope;
  const Opened opened = junction_at(mu, q2, exit_slope, opening);
  const double t = opened.junction.slope;
  const double e = opened.junction.e;
  const double exit_e = 1.0 + exit_slope * exit_slope;
  Candidate candidate;
  candidate.exit_slope = exit_slope;
  candidate.junction = opened.junction;
  candidate.flight = flight_to(mu, exit_slope, t);
  const Flight& flight = candidate.flight;
  const double scale = flight.speed2 * e * e;  // C
  const SlopeMoments m = slope_moments(mu, q2, {exit_slope, exit_e}, opened.junction);
  const double run = m.m2 + 4.0 * mu * m.k3;
  // Int (t - t1)^2 dt/E^3, from E = (t - t1)^2 - 2 (mu - t1)(t - t1) + E(t1)
  const double second = m.m2 + 2.0 * (mu - exit_slope) * m.k3 - exit_e * m.m3;
  const double drop = exit_slope * run + m.k2 + 4.0 * mu * second;
  candidate.run = flight.speed2 * flight.turn + scale * run;
  candidate.drop = 0.5 * flight.speed2 * flight.turn * (t + flight.entry_slope) + scale * drop;
  candidate.time = std::sqrt(flight.speed2) * flight.turn + std::sqrt(scale) * (m.m1 + 4.0 * mu * m.k2);

  const double entry_rate = 1.0 - flight.turn_rate;
  const double speed2_rate = -2.0 * flight.entry_slope * entry_rate * flight.speed2 * flight.speed2;
  const double scale_rate = (speed2_rate * e + 4.0 * flight.speed2 * (t - mu)) * e;
  const double density = (e + 4.0 * mu * (t - exit_slope)) / (e * e * e);
  const double run_flown_rate = speed2_rate * flight.turn + flight.speed2 * flight.turn_rate;
  const double drop_flown_rate = 0.5 * run_flown_rate * (t + flight.entry_slope) +
                                 0.5 * flight.speed2 * flight.turn * (1.0 + entry_rate);
  candidate.run_rate = opened.rate * (run_flown_rate + scale_rate * run + scale * density);
  candidate.drop_rate = opened.rate * (drop_flown_rate + scale_rate * drop + scale * density * t);
  return candidate;
}

/// Safeguarded Newton iteration on ln run over the opening; the run grows with it.
/// @param opening  where to begin; the opening found
Candidate track_with_run(const Task& task, double exit_slope, double& opening) {
  constexpr double kWidest = 700.0;
  constexpr double kLeastLeft = 34.0;  // beyond it a junction before E = 0 is that place but for rounding
  constexpr int kMostSteps = 100;
  constexpr double kConverged = 4.0 * std::numeric_limits<double>::epsilon();
  const bool bounded = 1.0 - task.mu * task.mu + 2.0 * task.mu * exit_slope <= 0.0;
  double below = 0.0;
  double above = bounded ? kLeastLeft : kWidest;
  opening = std::clamp(opening, 1e-3, 0.5 * above);
  Candidate candidate;
  for (int step = 0; step < kMostSteps; ++step) {
    candidate = candidate_at(task.mu, exit_slope, opening);
    // Not a number where a junction so far out has overflowed.
    const double excess = math::log(candidate.run / task.run);
    if (std::fabs(excess) <= kConverged) break;
    (excess < 0.0 ? below : above) = opening;
    double next = opening - excess * candidate.run / candidate.run_rate;
    if (!(next > below && next < above)) next = 0.5 * (below + above);
    const bool stuck = std::fabs(next - opening) <= kConverged * opening;
    opening = next;
    if (stuck) break;
  }
  return candidate;
}

Task task_of(double mu, double run, double drop) {
  constexpr double kSteepest = 1e12;
  Task task{mu,
            run,
            drop,
            least_drop(run, Friction::from_coefficient(mu), 1.0, 1.0),
            -kSteepest,
            drop / run,
            std::numeric_limits<double>::infinity()};
  if (mu == 0.0) return task;
  const double m2 = 1.0 + mu * mu;
  const double sine = mu / std::sqrt(m2);
  // The reach limit at this run: flight, then straight at slope mu - m, (R7) and (R8).
  const double k = 0.25 * (1.0 + sine);
  const double m = 2.0 * k * m2 / (run + std::sqrt(run * run + 4.0 * k * k * m2));
  task.least_slope = std::max(-kSteepest, -(1.0 - mu * mu + m * m) / (2.0 * mu));
  task.most_slope = (run * m2 / mu - 1.0) / mu;
  task.flight_drop = 0.5 * ((run / sine) * (run / sine) - 1.0);
  return task;
}

/// How far a drop is from the one that is wanted: from -1 at the reach limit to 1 for drops without end,
/// whatever the size of the task.
double drop_miss(const Task& task, double drop) {
  if (!std::isfinite(drop)) return 1.0;
  return (drop - task.drop) / ((drop - task.least_drop) + (task.drop - task.least_drop));
}

/// Bracketed in the exit slope, and in the opening for each: always finds the track.
Candidate searched_track(const Task& task) {
  double opening = 0.5;
  const auto miss_at = [&](double angle) {
    return drop_miss(task, track_with_run(task, math::sinh(angle), opening).drop);
  };
  constexpr int kAllBits = 53;
  std::uintmax_t steps = 200;
  const auto bracket = boost::math::tools::toms748_solve(
      miss_at, math::asinh(task.least_slope), math::asinh(task.most_slope), -1.0,
      drop_miss(task, task.flight_drop), boost::math::tools::eps_tolerance<double>(kAllBits), steps);
  return track_with_run(task, math::sinh(0.5 * (bracket.first + bracket.second)), opening);
}

/// A place in the family of tracks: asinh of the exit slope, and the opening.
struct Place {
  double angle = 0.0;
  double opening = 0.0;
};

/// Near enough for most tasks of practice: the second part turns as on a cycloid.
Place guessed_place(const Task& task) {
  const double chord = math::atan2(task.drop, task.run);
  const double half = math::atan(0.5 * task.run / (1.0 + std::max(0.0, 2.0 * task.drop) / (1.0 + task.run)));
  const double low = math::asinh(task.least_slope);
  const double high = math::asinh(task.most_slope);
  const double wanted = math::asinh(math::tan(std::max(chord - 0.6 * half, -1.5)));
  const double angle = std::clamp(wanted, low + 0.1 * (high - low), high - 0.1 * (high - low));
  const double junction = math::asinh(math::tan(std::min(chord + 0.75 * half, 1.55)));
  return {angle, std::max(junction - angle, 0.05)};
}

/// Newton's iteration on both numbers at once, from a guess and without safeguards.
/// @return the track; none where it does not converge at once
std::optional<Candidate> guessed_track(const Task& task) {
  constexpr int kMostSteps = 12;
  constexpr double kLongestStep = 1.0;
  constexpr double kStep = 1e-7;        // for the derivatives by the exit slope
  constexpr double kConverged = 1e-11;  // times the error of those derivatives it is below rounding
  Place place = guessed_place(task);
  for (int step = 0; step < kMostSteps; ++step) {
    if (!(place.opening > 0.0 && task.mu * math::sinh(place.angle) > -1.0)) return std::nullopt;
    const Candidate here = candidate_at(task.mu, math::sinh(place.angle), place.opening);
    const Candidate beside = candidate_at(task.mu, math::sinh(place.angle + kStep), place.opening);
    const double run_by_angle = (beside.run - here.run) / kStep;
    const double drop_by_angle = (beside.drop - here.drop) / kStep;
    const double run_missing = task.run - here.run;
    const double drop_missing = task.drop - here.drop;
    const double determinant = run_by_angle * here.drop_rate - drop_by_angle * here.run_rate;
    const double turn = (run_missing * here.drop_rate - drop_missing * here.run_rate) / determinant;
    const double opened = (run_by_angle * drop_missing - drop_by_angle * run_missing) / determinant;
    const double longest = std::max(std::fabs(turn), std::fabs(opened));
    if (!std::isfinite(longest)) return std::nullopt;
    const double share = std::min(1.0, kLongestStep / longest);
    place.angle += share * turn;
    place.opening = std::max(place.opening + share * opened, 0.1 * place.opening);
    if (longest < kConverged) return candidate_at(task.mu, math::sinh(place.angle), place.opening);
  }
  return std::nullopt;
}

/// The track whose second part is pressed on the ground: not all of it is flight.
Candidate pressed_track(const Task& task) {
  if (const auto track = guessed_track(task)) return *track;
  return searched_track(task);
}

/// What all solutions share.
FlyingStartSolution begun(const Endpoints& endpoints, Friction friction, double entry_speed, double gravity) {
  FlyingStartSolution solution;
  solution.entry_speed = entry_speed;
  solution.gravity = gravity;
  solution.endpoints = endpoints;
  solution.shape.friction_coefficient = friction.coefficient();
  return solution;
}

/// Straight to the finish, without loss: down or up, or too fast for anything else.
/// @param drop  Y
FlyingStartSolution straight(FlyingStartSolution solution, double drop) {
  const double v0 = solution.entry_speed;
  const Endpoints& ends = solution.endpoints;
  const double unscaled = v0 * v0 + 2.0 * solution.gravity * ends.drop;
  // Of two equal forms the one that stays within the range of numbers.
  solution.exit_speed = std::isfinite(unscaled) ? std::sqrt(unscaled) : v0 * std::sqrt(1.0 + 2.0 * drop);
  solution.travel_time = math::hypot(ends.run, ends.drop) / (0.5 * v0 + 0.5 * solution.exit_speed);
  solution.entry_slope_angle = Angle::from_radians(math::atan2(ends.drop, std::fabs(ends.run)));
  solution.flight_end_slope_angle = solution.entry_slope_angle;
  solution.exit_slope_angle = solution.entry_slope_angle;
  if (ends.run != 0.0) {
    solution.limit = FlyingStartLimit::straight;
    return solution;
  }
  solution.flight_time = solution.travel_time;
  solution.flight = {0.0, ends.drop};
  return solution;
}

/// The track from rest. A body that enters with speed is ahead by what it takes to fall to it; where the start is
/// vertical that is all.
FlyingStartSolution from_rest(FlyingStartSolution solution, Friction friction) {
  const CoulombSolution rest = solve_coulomb_brachistochrone(solution.endpoints, friction, solution.gravity);
  solution.limit = FlyingStartLimit::rest;
  solution.travel_time = rest.travel_time - solution.entry_speed / solution.gravity;
  solution.exit_speed = rest.exit_speed;
  solution.entry_slope_angle = Angle::from_radians(kRightAngle);
  solution.flight_end_slope_angle = solution.entry_slope_angle;
  solution.exit_slope_angle = rest.exit_slope_angle;
  return solution;
}

/// The flatter of the two parabolas through the finish.
FlyingStartSolution flown(FlyingStartSolution solution, const Task& task) {
  const double v0 = solution.entry_speed;
  const double exit_speed2 = 1.0 + 2.0 * task.drop;
  const double root = std::sqrt(exit_speed2 - task.run * task.run);
  FlyingStartShape& shape = solution.shape;
  shape.entry_slope = (2.0 * task.drop / task.run - task.run) / (1.0 + root);
  const double norm = 1.0 + shape.entry_slope * shape.entry_slope;
  shape.flight_turn = task.run * norm;
  shape.flight_end_slope = shape.entry_slope + shape.flight_turn;
  shape.exit_slope = shape.flight_end_slope;
  shape.horizontal_speed = v0 / std::sqrt(norm);
  solution.exit_speed = v0 * std::sqrt(exit_speed2);
  solution.travel_time = std::fabs(solution.endpoints.run) / shape.horizontal_speed;
  solution.flight_time = solution.travel_time;
  solution.flight = {std::fabs(solution.endpoints.run), solution.endpoints.drop};
  return solution;
}

/// @param time  of all of the way, in units of v0/g
/// @throws ConvergenceError if the track does not lead to the finish
void require_found(const Candidate& track, const Task& task, double time) {
  constexpr double kMiss = 1e-3;  // taste: what is found at all misses by rounding
  const double miss = math::hypot(track.run - task.run, track.drop - task.drop);
  const bool told = miss <= kMiss * math::hypot(task.run, task.drop);
  if (told && std::fabs(time - track.time) <= kMiss * time) return;
  throw ConvergenceError(
      {"",
       "fastest track: no track was found for run " + exact_text(task.run) + " and drop " +
           exact_text(task.drop) + " in units of v0^2/g, friction coefficient " + exact_text(task.mu),
       "So flat, at the limit of what can be reached or at a speed so low, slopes are no longer "
       "told apart.",
       "a drop that is more of the run"});
}

FlyingStartSolution pressed(FlyingStartSolution solution, const Task& task) {
  const Candidate track = pressed_track(task);
  const Flight& flight = track.flight;
  const double v0 = solution.entry_speed;
  const double length_unit = v0 / solution.gravity * v0;
  const double horizontal = std::sqrt(flight.speed2);
  const double costate = 1.0 / (horizontal * track.junction.e);
  const double time = track.time + costate * ((1.0 + task.mu * track.exit_slope) * (task.run - track.run) +
                                              (track.exit_slope - task.mu) * (task.drop - track.drop));
  require_found(track, task, time);
  FlyingStartShape& shape = solution.shape;
  shape.entry_slope = flight.entry_slope;
  shape.flight_turn = flight.turn;
  shape.flight_end_slope = track.junction.slope;
  shape.flight_end_e = track.junction.e;
  shape.exit_slope = track.exit_slope;
  shape.horizontal_speed = v0 * horizontal;
  solution.travel_time = v0 / solution.gravity * time;
  solution.exit_speed =
      v0 * horizontal * track.junction.e / std::sqrt(1.0 + track.exit_slope * track.exit_slope);
  solution.flight_time = v0 / solution.gravity * horizontal * flight.turn;
  solution.flight = {
      length_unit * flight.speed2 * flight.turn,
      length_unit * 0.5 * flight.speed2 * flight.turn * (track.junction.slope + flight.entry_slope)};
  return solution;
}

}  // namespace
}  // namespace centerline

FlyingStartSolution solve_flying_start(const Endpoints& endpoints, Friction friction, double entry_speed,
                                       double gravity) {
  using namespace centerline;
  require_gravity(gravity);
  require_reachable_with_speed(endpoints, friction, entry_speed, gravity);
  FlyingStartSolution solution = begun(endpoints, friction, entry_speed, gravity);
  if (as_from_rest(endpoints, entry_speed, gravity)) return from_rest(solution, friction);
  const double unit = entry_speed / gravity * entry_speed;
  const double mu = friction.coefficient();
  const double run = std::fabs(endpoints.run) / unit;
  const double drop = endpoints.drop / unit;
  // measured: as near to a vertical line as this a track told by its slopes is off by 1e-4 of its length, and the
  // vertical by 1e-12
  constexpr double kSteep = 1e-12;
  const bool steep = run < kSteep * std::fabs(drop);
  if (steep || !(run > std::numeric_limits<double>::min())) return straight(solution, drop);
  const Task task = task_of(mu, run, drop);
  const bool flies = run * run * (1.0 + mu * mu) <= mu * mu * (1.0 + 2.0 * drop);
  // It turns by X, by more where it slows down.
  if (!flies && run < kStraightTurn * std::min(1.0, 1.0 + 2.0 * drop)) return straight(solution, drop);
  solution = flies ? flown(solution, task) : pressed(solution, task);
  solution.entry_slope_angle = Angle::from_radians(math::atan(solution.shape.entry_slope));
  solution.flight_end_slope_angle = Angle::from_radians(math::atan(solution.shape.flight_end_slope));
  solution.exit_slope_angle = Angle::from_radians(math::atan(solution.shape.exit_slope));
  return solution;
}

}  // namespace glissade
