#pragma once

#include "glissade/centerline/centerline.hpp"
#include "glissade/motion/motion.hpp"
#include "glissade/optimize/optimize.hpp"

#include "optimize/problem/changed_bound.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

/// Prices beside differences of problems solved again with other bounds.
namespace glissade::testing_problems {

// What a price may miss of what re-solves win.
inline constexpr double kPriceAccuracy = 0.02;
// By so much of the objective two searches of neighbouring problems may end apart.
inline constexpr double kSearchNoise = 5e-7;
// A step is to win this share of the objective, ...
inline constexpr double kShare = 2e-4;
// ... but to change its bound by no more than this share of it, or of what a violation is measured against.
inline constexpr double kLongestStep = 0.01;
// Prices below this many times the noise of such a difference are not compared.
inline constexpr double kTells = 50.0;

/// What is made least, as a ride tells it, in the units of prices.
inline double objective_of(const Problem& problem, const Optimum& optimum) {
  double time = optimum.report.travel_time;
  double speed = optimum.report.exit_speed;
  if (problem.objective.worst_case && problem.high_friction) {
    Body body = problem.body;
    body.friction = *problem.high_friction;
    const Motion worst(optimum.centerline, body, problem.gravity);
    time = worst.travel_time();
    speed = worst.exit_speed();
  }
  const Objective& objective = problem.objective;
  if (objective.kind == ObjectiveKind::exit_speed) return -speed;
  return objective.kind == ObjectiveKind::blend ? time - objective.exit_speed_weight * speed : time;
}

/// Half-planes that begin on their line: the same as many lines further away, whose clearances can give way.
inline Problem with_room_to_give_way(Problem problem) {
  const double room = 0.05 * std::hypot(problem.endpoints.run, problem.endpoints.drop);
  for (HalfPlane& plane : problem.limits.half_planes) {
    const double length = std::hypot(plane.forbidden.x, plane.forbidden.y);
    plane.point = plane.point + (room / length) * plane.forbidden;
    plane.clearance += room;
  }
  return problem;
}

/// The problem with one bound wider, or a waypoint moved down across the track (of a value to be met exactly: larger).
/// @param by  in the unit of the bound [SI]; below 0: tighter
/// @return none where no key says that
inline std::optional<Problem> giving_way(const Problem& problem, const Optimum& optimum,
                                         const LimitName& limit, double bound, double by) {
  if (limit.id == LimitId::concave) {
    if (by < 0.0) return std::nullopt;
    Problem changed = problem;
    changed.limits.concave = by == 0.0;
    changed.limits.smallest_crest_radius = by > 0.0 ? std::optional(1.0 / by) : std::nullopt;
    return changed;
  }
  if (limit.id == LimitId::waypoints) {
    Problem changed = problem;
    Vec2& point = changed.limits.waypoints[limit.index];
    const Centerline& track = *optimum.centerline;
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 across;
    constexpr int kPlaces = 4000;
    for (int i = 0; i <= kPlaces; ++i) {
      const double s = track.length() * i / kPlaces;
      const CenterlinePoint there = track.at(std::min(s, track.length()));
      const double distance = std::hypot(there.x - point.x, there.drop - point.y);
      if (distance >= nearest) continue;
      nearest = distance;
      across = {-std::sin(there.slope_angle), std::cos(there.slope_angle)};
    }
    point = point + by * across;
    return changed;
  }
  return optimizer::with_bound(problem, limit, bound + (limit.bound == Bound::lowest ? -by : by));
}

/// The polynomial through the chosen ones of some values (by Lagrange), between them.
inline double through(const std::array<double, 7>& values, unsigned chosen, double at) {
  double sum = 0.0;
  for (unsigned i = 0; i < values.size(); ++i) {
    if ((chosen >> i & 1U) == 0) continue;
    double weight = 1.0;
    for (unsigned k = 0; k < values.size(); ++k) {
      if (k != i && (chosen >> k & 1U) != 0) weight *= (at - k) / (static_cast<double>(i) - k);
    }
    sum += weight * values[i];
  }
  return sum;
}

/// What is won for each unit by which a bound gives way, between six problems whose bounds lie one step apart, the
/// problem's own in their middle.
struct Differences {
  std::array<double, 6> steps{};
  double noise = 0.0;  ///< of each
  double step = 0.0;   ///< of the bound [SI]

  /// At the bound itself: the slope of the cubic through four of the seven objectives that all of them lie closest to, by the
  /// sum of distances. A search that ends beside its neighbours does not move it, nor does a price that changes fast.
  [[nodiscard]] double central() const {
    std::array<double, 7> won{};
    for (std::size_t k = 0; k < steps.size(); ++k) won[k + 1] = won[k] + steps[k];
    double least = std::numeric_limits<double>::infinity();
    double slope = 0.0;
    for (unsigned chosen = 0; chosen < 1U << won.size(); ++chosen) {
      if (std::popcount(chosen) != 4) continue;
      const auto cubic = [&](double at) { return through(won, chosen, at); };
      double apart = 0.0;
      for (std::size_t k = 0; k < won.size(); ++k) apart += std::fabs(won[k] - cubic(static_cast<double>(k)));
      if (apart >= least) continue;
      least = apart;
      // Of a cubic this is its slope in the middle.
      slope = (8.0 * (cubic(3.5) - cubic(2.5)) - (cubic(4.0) - cubic(2.0))) / 6.0;
    }
    return slope;
  }
  /// On the side where the bound is tighter, and where it is looser.
  [[nodiscard]] double tighter() const { return (steps[0] + steps[1] + steps[2]) / 3.0; }
  [[nodiscard]] double looser() const { return (steps[3] + steps[4] + steps[5]) / 3.0; }
  /// The same next to the bound, from steps on that side alone.
  [[nodiscard]] double just_tighter() const { return steps[2] + 0.25 * (steps[2] - steps[0]); }
  [[nodiscard]] double just_looser() const { return steps[3] + 0.25 * (steps[3] - steps[5]); }
  /// How far steps on one side lie from each other, over what a smooth change between the sides explains.
  [[nodiscard]] double scatter() const {
    const double change = std::fabs(looser() - tighter());
    double most = 0.0;
    for (const std::size_t side : {std::size_t{0}, std::size_t{3}}) {
      const auto [low, high] = std::minmax({steps[side], steps[side + 1], steps[side + 2]});
      most = std::max(most, high - low - change);
    }
    return std::max(most, 0.0);
  }
  /// Whether the price is told between two that differ: the bound lies where another limit begins to bind.
  [[nodiscard]] bool has_kink_at(double price) const {
    const auto [low, high] = std::minmax({tighter(), looser()});
    return high - low > 2.0 * kPriceAccuracy * high && price > low - noise && price < high + noise;
  }
};

/// @param price  that is expected, greater than 0
/// @param size   of the bound
/// @return none where no difference tells, or a neighbour has no track
inline std::optional<Differences> differences_of(const Problem& problem, const Optimum& optimum,
                                                 const LimitName& limit, double bound, double price,
                                                 double size) {
  const double objective = objective_of(problem, optimum);
  const double wanted = kShare * std::fabs(objective) / price;
  Differences differences;
  differences.step = std::min(wanted, kLongestStep * size);
  differences.noise = kSearchNoise * std::fabs(objective) / differences.step;
  if (!(price > kTells * differences.noise)) return std::nullopt;
  std::array<double, 7> objectives{};
  for (int k = -3; k <= 3; ++k) {
    const auto changed = giving_way(problem, optimum, limit, bound, k * differences.step);
    double& value = objectives[static_cast<std::size_t>(k + 3)];
    value = std::numeric_limits<double>::quiet_NaN();
    if (!changed) {
      if (limit.id == LimitId::concave) continue;
      return std::nullopt;
    }
    OptimizeOptions options;
    options.time_budget = 1e6;
    const Optimum there = k == 0 ? optimum : optimize(*changed, options);
    if (there.report.status != OptimizeStatus::optimal) return std::nullopt;
    value = objective_of(*changed, there);
  }
  const double sign = limit.bound == Bound::exactly && objectives.back() > objectives.front() ? -1.0 : 1.0;
  for (std::size_t k = 0; k < differences.steps.size(); ++k) {
    differences.steps[k] = sign * (objectives[k] - objectives[k + 1]) / differences.step;
  }
  return differences;
}

}  // namespace glissade::testing_problems
