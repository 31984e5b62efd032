#include "optimize/search/starts.hpp"

#include "glissade/centerline/fastest_track.hpp"
#include "glissade/centerline/reach.hpp"
#include "glissade/core/math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glissade::optimizer {
namespace {

/// Of a track that is not much longer than its chord.
double mean_friction(const ScaledProblem& problem, const Ride& ride) {
  double mean = ride.friction;
  for (std::size_t i = 0; i < problem.changes.size(); ++i) {
    mean += (ride.friction_in(i + 1) - ride.friction_in(i)) * std::max(0.0, 1.0 - problem.changes[i]);
  }
  return mean;
}

/// Where the search expects a free finish.
Vec2 expected_finish(const ScaledProblem& problem) {
  Vec2 finish{problem.run, problem.drop};
  const auto within = [&](LimitId coordinate, double value) {
    for (const LimitSpec& limit : problem.limits) {
      if (limit.name.id != coordinate) continue;
      if (limit.side <= 0) value = std::max(value, limit.bound);
      if (limit.side >= 0) value = std::min(value, limit.bound);
    }
    return value;
  };
  const double mu = mean_friction(problem, problem.rides.back());
  switch (problem.finish) {
    case FinishKind::point:
      break;
    case FinishKind::vertical_line:
      // The frictionless cycloid that meets a wall squarely has dropped 2/pi of its run.
      finish.y = within(LimitId::finish_drop, finish.x * (2.0 / std::numbers::pi + 1.2 * mu));
      break;
    case FinishKind::level:
      finish.x = within(LimitId::finish_run, 0.5 * std::fabs(finish.y) / std::max(mu, 1.0));
      break;
    case FinishKind::anywhere: {
      // A quarter more than the drop of free fall goes with friction, and with a slope as steep as is allowed.
      constexpr double kLost = 1.25;   // taste
      constexpr double kRubbed = 1.2;  // taste: of what friction takes on the way to a run that is asked for
      constexpr double kSteepest = 1.0;  // taste
      double slope = kSteepest;
      for (const LimitSpec& limit : problem.limits) {
        if (limit.measure == Measure::slope_angle && limit.side > 0)
          slope = std::min(slope, math::tan(std::min(limit.bound, 0.25 * std::numbers::pi)));
      }
      finish.y = within(LimitId::finish_drop, kLost * problem.fall);
      const double run = finish.y / std::max(0.8 * slope, 1.5 * mu);
      finish.x = within(LimitId::finish_run, run);
      if (finish.x > run)
        finish.y = within(LimitId::finish_drop, std::max(finish.y, problem.fall + kRubbed * mu * finish.x));
      break;
    }
  }
  return finish;
}

GuessCurve straight(Vec2 finish) {
  GuessCurve curve;
  const double angle = math::atan2(finish.y, finish.x);
  constexpr int kSteps = 64;  // taste
  for (int i = 0; i <= kSteps; ++i) {
    // A little sag breaks the tie between the two ways to bend.
    const double share = static_cast<double>(i) / kSteps;
    curve.sigma.push_back(share);
    curve.zeta.push_back(angle + 0.1 * (1.0 - 2.0 * share));
  }
  curve.length = norm(finish);
  return curve;
}

/// Slope angles held within the limits on them.
GuessCurve clipped(GuessCurve curve, const ScaledProblem& problem) {
  for (const LimitSpec& limit : problem.limits) {
    if (limit.measure != Measure::slope_angle) continue;
    for (double& zeta : curve.zeta)
      zeta = limit.side > 0 ? std::min(zeta, limit.bound) : std::max(zeta, limit.bound);
  }
  return curve;
}

/// Turning no faster than the body fits into.
GuessCurve widened(GuessCurve curve, double height) {
  constexpr double kShare = 0.5;  // of the curvature at which it no longer fits; taste
  if (height == 0.0) return curve;
  for (std::size_t i = curve.sigma.size() - 1; i-- > 0;) {
    const double ds = (curve.sigma[i + 1] - curve.sigma[i]) * curve.length;
    curve.zeta[i] = std::min(curve.zeta[i], curve.zeta[i + 1] + kShare * ds / height);
  }
  return curve;
}

}  // namespace

std::vector<GuessCurve> starts(const ScaledProblem& problem) {
  const Vec2 finish = expected_finish(problem);
  const double ends = problem.lead_in + problem.lead_out;
  const double mu = mean_friction(problem, problem.rides[problem.objective_ride]);
  std::vector<GuessCurve> curves;
  // A body that enters faster than it would fall needs no steep start.
  const bool from_rest_like = 0.5 * problem.entry_speed2 < 0.5 * finish.y;
  if (finish.y > 0.0 && from_rest_like) {
    const double reachable = std::min(mu, 0.98 * finish.y / finish.x);
    curves.push_back(brachistochrone_guess(finish.x, finish.y, reachable));
    const double gentle = std::min(mu, 0.6 * finish.y / finish.x);
    if (gentle < reachable) curves.push_back(brachistochrone_guess(finish.x, finish.y, gentle));
    curves.push_back(clipped(curves.front(), problem));
  }
  curves.push_back(straight(finish));
  for (GuessCurve& curve : curves) curve = widened(std::move(curve), problem.rides.front().height);
  for (GuessCurve& curve : curves) curve.length = std::max(curve.length - ends, 0.2 * curve.length);
  return curves;
}

std::optional<GuessCurve> straight_line(const ScaledProblem& problem, Vec2 finish) {
  const double length = norm(finish);
  const double between = length - problem.lead_in - problem.lead_out;
  if (!(between > 2.0 * kShortestCore)) return std::nullopt;
  const double angle = math::atan2(finish.y, finish.x);
  constexpr std::size_t kSteps = 64;  // taste
  GuessCurve curve;
  for (std::size_t i = 0; i <= kSteps; ++i) curve.sigma.push_back(static_cast<double>(i) / kSteps);
  curve.zeta.assign(kSteps + 1, angle);
  curve.length = between;
  return curve;
}

std::optional<GuessCurve> curve_along(const ScaledProblem& problem, const Centerline& track) {
  constexpr std::size_t kSteps = 128;  // taste
  const double between = track.length() / problem.chord - problem.lead_in - problem.lead_out;
  if (!(between > 2.0 * kShortestCore)) return std::nullopt;
  GuessCurve curve;
  curve.length = between;
  for (std::size_t i = 0; i <= kSteps; ++i) {
    curve.sigma.push_back(static_cast<double>(i) / kSteps);
    const double s = (problem.lead_in + curve.sigma.back() * between) * problem.chord;
    curve.zeta.push_back(track.at(std::min(s, track.length())).slope_angle);
  }
  return curve;
}

std::optional<FlyingStart> flying_start(const ScaledProblem& problem) {
  constexpr int kSteps = 128;     // taste
  constexpr double kSlow = 1.01;  // taste: of the speed that just arrives
  const Vec2 finish = expected_finish(problem);
  const Endpoints ends{finish.x, finish.y};
  const Friction friction =
      Friction::from_coefficient(mean_friction(problem, problem.rides[problem.objective_ride]));
  const double entry_speed = std::sqrt(problem.entry_speed2);
  if (!(entry_speed > 0.0 && finish.x > 0.0)) return std::nullopt;
  if (entry_speed < kSlow * least_entry_speed(ends, friction, 1.0)) return std::nullopt;
  const FastestTrack track = fastest_track(ends, friction, entry_speed, 1.0);
  FlyingStart start;
  start.travel_time = track.travel_time;
  const double length = track.centerline->length();
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    start.curve.sigma.push_back(share);
    start.curve.zeta.push_back(track.centerline->slope_angle(share * length));
  }
  start.curve = widened(std::move(start.curve), problem.rides.front().height);
  start.curve.length = std::max(length - problem.lead_in - problem.lead_out, 0.2 * length);
  return start;
}

double straight_time(const ScaledProblem& problem) {
  const Vec2 finish = expected_finish(problem);
  const double length = norm(finish);
  const double mu = mean_friction(problem, problem.rides[problem.objective_ride]);
  const double fall = finish.y - mu * finish.x;
  const double exit_speed2 = problem.entry_speed2 + 2.0 * fall;
  if (!(exit_speed2 > 0.0)) return HUGE_VAL;
  const double speeds = std::sqrt(problem.entry_speed2) + std::sqrt(exit_speed2);
  return 2.0 * length / speeds;
}

std::vector<GuessCurve> winding_starts(const ScaledProblem& problem) {
  constexpr int kSteps = 128;                   // taste
  constexpr int kMostWaves = 3;                 // taste
  constexpr double kAmplitudes[] = {0.4, 0.8};  // [rad]; taste
  const Vec2 finish = expected_finish(problem);
  const double ends = problem.lead_in + problem.lead_out;
  const double mean = math::atan2(finish.y, finish.x);
  std::vector<GuessCurve> curves;
  for (int waves = 1; waves <= kMostWaves; ++waves) {
    for (const double amplitude : kAmplitudes) {
      GuessCurve curve;
      double along = 0.0;
      for (int i = 0; i <= kSteps; ++i) {
        const double share = static_cast<double>(i) / kSteps;
        const double turned = amplitude * math::cos(2.0 * std::numbers::pi * waves * share);
        curve.sigma.push_back(share);
        curve.zeta.push_back(mean + turned);
        if (i < kSteps) along += math::cos(turned) / kSteps;
      }
      curve.length = norm(finish) / along;
      curve = clipped(std::move(curve), problem);
      curve.length = std::max(curve.length - ends, 0.2 * curve.length);
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

std::vector<GuessCurve> constant_speed_starts(const ScaledProblem& problem) {
  constexpr int kSteps = 128;        // taste
  constexpr int kHalvings = 40;      // rounding: 2^-40
  constexpr double kSteepest = 1.3;  // [rad], at the start; taste
  const Vec2 finish = expected_finish(problem);
  const double mu = mean_friction(problem, problem.rides[problem.objective_ride]);
  const double delta = math::atan(mu);
  const double along = finish.x * math::cos(delta) + finish.y * math::sin(delta);
  const double across = finish.y * math::cos(delta) - finish.x * math::sin(delta);
  if (!(mu > 0.0) || !(across > 0.0)) return {};
  // docs/theory.md (C3), (C4), (C7): psi = zeta - delta, by the rate k at which tan(psi/2) falls.
  const auto entry = [&](double rate) {
    return math::atan2(math::sin(rate * across), math::cos(rate * across) - math::exp(-rate * along));
  };
  double low = 0.0;
  double high = std::numbers::pi / across;
  for (int i = 0; i < kHalvings; ++i) {
    const double rate = 0.5 * (low + high);
    (entry(rate) + delta < kSteepest ? low : high) = rate;
  }
  const double first = entry(low);
  const double last = first - low * across;
  // Close to the reach limit psi vanishes at the exit, to rounding, and the track has no end.
  if (!(first > 0.0 && last > 0.0)) return {};
  GuessCurve curve;
  const double whole = math::log(math::tan(0.5 * first) / math::tan(0.5 * last)) / low;
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const double psi = 2.0 * math::atan(math::tan(0.5 * first) * math::exp(-low * share * whole));
    curve.sigma.push_back(share);
    curve.zeta.push_back(psi + delta);
  }
  curve.length = std::max(whole - problem.lead_in - problem.lead_out, 0.2 * whole);
  return {curve};
}

namespace {

/// A piece of a staircase.
struct Step {
  double length = 0.0;
  double slope_angle = 0.0;
};

GuessCurve staircase(const std::vector<Step>& steps, double ends) {
  constexpr int kSteps = 256;  // taste
  GuessCurve curve;
  double whole = 0.0;
  for (const Step& step : steps) whole += step.length;
  double done = 0.0;
  auto step = steps.begin();
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    while (step + 1 != steps.end() && share * whole > done + step->length) done += (step++)->length;
    curve.sigma.push_back(share);
    curve.zeta.push_back(step->slope_angle);
  }
  curve.length = std::max(whole - ends, 0.2 * whole);
  return curve;
}

}  // namespace

std::vector<GuessCurve> stepped_starts(const ScaledProblem& problem) {
  constexpr double kSteepest = 1.3;   // [rad]; taste
  constexpr double kFlattest = -0.6;  // [rad]; taste
  const Vec2 finish = expected_finish(problem);
  double steep = kSteepest;
  double flat = kFlattest;
  for (const LimitSpec& limit : problem.limits) {
    if (limit.measure != Measure::slope_angle) continue;
    if (limit.side > 0) steep = std::min(steep, limit.bound);
    if (limit.side < 0) flat = std::max(flat, limit.bound);
  }
  const double mean = math::atan2(finish.y, finish.x);
  if (!(flat < mean && mean < steep)) return {};
  const auto steps_of = [&](const std::vector<double>& runs, double softness) {
    // Each share of the run in two: steep, then flat.
    const double down = mean + softness * (steep - mean);
    const double level = mean + softness * (flat - mean);
    const double part = (finish.y / finish.x - math::tan(level)) / (math::tan(down) - math::tan(level));
    std::vector<Step> steps;
    for (const double run : runs) {
      steps.push_back({run * finish.x * part / math::cos(down), down});
      steps.push_back({run * finish.x * (1.0 - part) / math::cos(level), level});
    }
    return steps;
  };
  // One long ledge, early on: shares of all that is steep, and of all that is flat, in front of its end.
  const auto ledge = [&](double before, double flat_share) {
    std::vector<Step> steps = steps_of({1.0, 1.0}, 1.0);
    steps[0].length *= before;
    steps[1].length *= flat_share;
    steps[2].length *= 1.0 - before;
    steps[3].length *= 1.0 - flat_share;
    return steps;
  };
  const double ends = problem.lead_in + problem.lead_out;
  std::vector<GuessCurve> curves;
  curves.push_back(staircase(ledge(0.1, 0.7), ends));
  curves.push_back(staircase(ledge(0.2, 0.5), ends));
  curves.push_back(staircase(steps_of({1.0 / 3, 1.0 / 3, 1.0 / 3}, 0.5), ends));
  curves.push_back(staircase(steps_of({0.25, 0.25, 0.25, 0.25}, 1.0), ends));
  curves.push_back(staircase(steps_of({1.0 / 7, 2.0 / 7, 4.0 / 7}, 0.5), ends));
  return curves;
}

namespace {

/// The digits of a number mirrored at the point: the first n fill [0, 1) evenly, and in several dimensions with a
/// prime for each.
/// Source: J. H. Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
/// multi-dimensional integrals", Numerische Mathematik 2 (1960) 84-90.
double mirrored_digits(int number, int base) {
  double result = 0.0;
  double digit = 1.0 / base;
  for (; number > 0; number /= base, digit /= base) result += digit * (number % base);
  return result;
}

}  // namespace

std::vector<GuessCurve> starts_to_other_runs(const ScaledProblem& problem) {
  // Of the nearest that is allowed.
  constexpr double kRuns[] = {1.0, 1.5, 2.5, 4.0};  // taste
  // By which slope angles at the ends are off the mean [rad].
  constexpr double kCrests[] = {0.05, 0.5};  // taste
  const bool is_free = problem.finish == FinishKind::anywhere || problem.finish == FinishKind::level;
  if (!is_free) return {};
  const Vec2 expected = expected_finish(problem);
  double nearest = 0.0;
  double farthest = HUGE_VAL;
  for (const LimitSpec& limit : problem.limits) {
    if (limit.name.id != LimitId::finish_run) continue;
    if (limit.side <= 0) nearest = std::max(nearest, limit.bound);
    if (limit.side >= 0) farthest = std::min(farthest, limit.bound);
  }
  if (!(nearest > 0.0)) nearest = 0.5 * expected.x;
  const double ends = problem.lead_in + problem.lead_out;
  std::vector<GuessCurve> curves;
  for (const double times : kRuns) {
    const double run = times * nearest;
    if (run > farthest) break;
    for (const double crest : kCrests) {
      GuessCurve curve = straight({run, expected.y});
      const double mean = math::atan2(expected.y, run);
      double along = 0.0;
      for (std::size_t i = 0; i < curve.sigma.size(); ++i) {
        const double turned = crest * (2.0 * curve.sigma[i] - 1.0);
        curve.zeta[i] = mean + turned;
        along += math::cos(turned) / static_cast<double>(curve.sigma.size());
      }
      curve.length /= along;
      curve = clipped(std::move(curve), problem);
      curve.length = std::max(curve.length - ends, 0.2 * curve.length);
      curves.push_back(std::move(curve));
    }
  }
  return curves;
}

std::vector<GuessCurve> scattered_starts(const ScaledProblem& problem) {
  // measured: of a problem that 8 % of such curves solve 32 find a track in 14 of 15 cases
  constexpr int kCurves = 32;
  constexpr double kMostAmplitude = 0.8;             // [rad]; taste
  constexpr double kWaves[] = {0.3, 3.0};            // taste
  constexpr double kMostTurn = 0.5;                  // [rad], from end to end, either way; taste
  constexpr double kLonger = 0.3;                    // chords a radian of amplitude; taste
  constexpr double kNearlyUpright[] = {-1.5, 1.55};  // [rad]; taste
  constexpr int kBases[] = {2, 3, 5, 7, 11};         // theory: primes
  const std::vector<GuessCurve> likely = starts(problem);
  const Vec2 finish = expected_finish(problem);
  const double mean = math::atan2(finish.y, finish.x);
  std::vector<GuessCurve> curves;
  for (int i = 1; i <= kCurves; ++i) {
    GuessCurve curve = likely[static_cast<std::size_t>(i) % likely.size()];
    const auto between = [&](int dimension, double low, double high) {
      return low + (high - low) * mirrored_digits(i, kBases[dimension]);
    };
    const double kept = between(0, 0.0, 1.0);
    const double amplitude = between(1, 0.0, kMostAmplitude);
    const double waves = between(2, kWaves[0], kWaves[1]);
    const double phase = between(3, 0.0, 2.0 * std::numbers::pi);
    const double turn = between(4, -kMostTurn, kMostTurn);
    for (std::size_t k = 0; k < curve.sigma.size(); ++k) {
      const double wave = amplitude * math::sin(2.0 * std::numbers::pi * waves * curve.sigma[k] + phase);
      const double zeta = mean + kept * (curve.zeta[k] - mean) + wave + turn * (0.5 - curve.sigma[k]);
      curve.zeta[k] = std::clamp(zeta, kNearlyUpright[0], kNearlyUpright[1]);
    }
    curve.length *= 1.0 + kLonger * amplitude;
    curves.push_back(std::move(curve));
  }
  return curves;
}

std::optional<double> unlimited_travel_time(const Problem& problem) {
  const Body& body = problem.body;
  const bool applies = problem.finish.kind == FinishKind::point && is_sliding_point(body) &&
                       body.drag_per_metre == 0.0 &&
                       can_arrive(problem.endpoints, body.friction, body.entry_speed, problem.gravity);
  if (!applies) return std::nullopt;
  return fastest_travel_time(problem.endpoints, body.friction, body.entry_speed, problem.gravity);
}

}  // namespace glissade::optimizer
