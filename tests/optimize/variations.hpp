#pragma once

#include "glissade/optimize/optimize.hpp"
#include "glissade/task/limit_catalogue.hpp"

#include "clearance/random_case.hpp"
#include "optimize/drawn_problems.hpp"
#include "optimize/problem/changed_bound.hpp"
#include "optimize/random_limits.hpp"
#include "support/random.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// One thing of a problem is changed: what that may do to its answer is known without solving anything.
namespace glissade::testing_problems {

/// What a change may do to the answer.
enum class Order {
  no_worse,  ///< never infeasible, never a longer time
  same,      ///< the same answer, in its own units
  solves     ///< a problem without a track has one now
};

struct Variation {
  std::string kind;   ///< "without", "wider", "narrower friction", "mirrored", ...
  std::string limit;  ///< as LimitName::key(); empty where no limit is changed
  Order order = Order::no_worse;
  Problem problem;
  double time_unit = 1.0;  ///< of the changed problem, over that of the other
  double speed_unit = 1.0;

  [[nodiscard]] std::string name() const { return limit.empty() ? kind : kind + " " + limit; }
};

/// By how much of its time or speed the answer to a changed problem is worse than that to the problem itself.
inline double slower_by(const Variation& variation, const OptimizeReport& known,
                        const OptimizeReport& changed) {
  const Objective& objective = variation.problem.objective;
  const auto of = [&](const OptimizeReport& report, double time_unit, double speed_unit) {
    const double time = report.travel_time / time_unit;
    const double speed = report.exit_speed / speed_unit;
    if (objective.kind == ObjectiveKind::exit_speed) return -speed;
    return objective.kind == ObjectiveKind::blend ? time - objective.exit_speed_weight * speed : time;
  };
  const bool is_speed = objective.kind == ObjectiveKind::exit_speed;
  return (of(changed, variation.time_unit, variation.speed_unit) - of(known, 1.0, 1.0)) /
         (is_speed ? known.exit_speed : known.travel_time);
}

/// The limits of a problem, one side each.
inline std::vector<LimitName> limits_of(const Problem& problem) {
  const Limits& limits = problem.limits;
  std::vector<LimitName> names;
  for (const LimitEntry& entry : limit_catalogue()) {
    if (entry.range != nullptr) {
      const Range& range = limits.*entry.range;
      if (range.lowest) names.push_back({entry.id, Bound::lowest, 0});
      if (range.highest) names.push_back({entry.id, Bound::highest, 0});
    }
    const bool is_contact = entry.id == LimitId::lowest_normal_load && limits.lowest_normal_load == 0.0;
    if (entry.value != nullptr && limits.*entry.value && !is_contact)
      names.push_back({entry.id, entry.bound, 0});
    if (entry.length != nullptr && limits.*entry.length > 0.0) names.push_back({entry.id, entry.bound, 0});
    if (entry.id == LimitId::concave && limits.concave) names.push_back({entry.id, entry.bound, 0});
  }
  const auto add_list = [&](LimitId id, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) names.push_back({id, entry_of(id).bound, i});
  };
  add_list(LimitId::half_planes, limits.half_planes.size());
  add_list(LimitId::keep_outs, limits.keep_outs.size());
  add_list(LimitId::stay_above, limits.stay_above.size());
  add_list(LimitId::stay_below, limits.stay_below.size());
  add_list(LimitId::waypoints, limits.waypoints.size());
  const LimitId free_end =
      problem.finish.kind == FinishKind::level ? LimitId::finish_run : LimitId::finish_drop;
  if (problem.finish.free_range.lowest) names.push_back({free_end, Bound::lowest, 0});
  if (problem.finish.free_range.highest) names.push_back({free_end, Bound::highest, 0});
  return names;
}

/// One side of one limit left out.
inline Problem without(Problem problem, const LimitName& name) {
  Limits& limits = problem.limits;
  const LimitEntry& entry = entry_of(name.id);
  const auto drop_side = [&](Range& range) {
    (name.bound == Bound::lowest ? range.lowest : range.highest).reset();
  };
  const auto erase = [&](auto& list) { list.erase(list.begin() + static_cast<std::ptrdiff_t>(name.index)); };
  if (entry.range != nullptr) drop_side(limits.*entry.range);
  if (entry.value != nullptr) (limits.*entry.value).reset();
  if (name.id == LimitId::lowest_normal_load) limits.lowest_normal_load = 0.0;
  if (entry.length != nullptr) limits.*entry.length = 0.0;
  if (name.id == LimitId::concave) limits.concave = false;
  if (name.id == LimitId::half_planes) erase(limits.half_planes);
  if (name.id == LimitId::keep_outs) erase(limits.keep_outs);
  if (name.id == LimitId::stay_above) erase(limits.stay_above);
  if (name.id == LimitId::stay_below) erase(limits.stay_below);
  if (name.id == LimitId::waypoints) erase(limits.waypoints);
  if (name.id == LimitId::finish_run || name.id == LimitId::finish_drop) drop_side(problem.finish.free_range);
  return problem;
}

/// One side of one limit given way a little. @return none for what has no bound
inline std::optional<Problem> wider(const Problem& problem, const LimitName& name) {
  Problem changed = problem;
  Limits& limits = changed.limits;
  const LimitEntry& entry = entry_of(name.id);
  const double chord = std::hypot(problem.endpoints.run, problem.endpoints.drop);
  const double side = name.bound == Bound::lowest ? -1.0 : 1.0;
  // Lines give way as ground does: not their clearance alone, they move.
  const auto moved = [&](std::vector<Vec2>& line, double by) {
    for (Vec2& point : line) point.y += by;
  };
  constexpr double kMove = 0.02;
  switch (name.id) {
    case LimitId::half_planes: {
      HalfPlane& plane = limits.half_planes[name.index];
      plane.point = plane.point + (kMove * chord / norm(plane.forbidden)) * plane.forbidden;
      return changed;
    }
    case LimitId::keep_outs:
      if (!(limits.keep_outs[name.index].clearance > 0.0)) return std::nullopt;
      limits.keep_outs[name.index].clearance *= 0.7;
      return changed;
    case LimitId::stay_above:
      moved(limits.stay_above[name.index].line, kMove * chord);
      return changed;
    case LimitId::stay_below:
      moved(limits.stay_below[name.index].line, -kMove * chord);
      return changed;
    case LimitId::concave:
    case LimitId::waypoints:
      return std::nullopt;
    default:
      break;
  }
  double value = 0.0;
  double least = -HUGE_VAL;
  if (entry.range != nullptr) {
    const Range& range = limits.*entry.range;
    value = name.bound == Bound::lowest ? *range.lowest : *range.highest;
    least = entry.least;
  } else if (entry.value != nullptr) {
    value = *(limits.*entry.value);
  } else if (entry.length != nullptr) {
    limits.*entry.length *= 0.8;
    return changed;
  } else {
    const Range& range = problem.finish.free_range;
    value = name.bound == Bound::lowest ? *range.lowest : *range.highest;
  }
  const bool is_angle = entry.dimension == Dimension::angle;
  double bound = is_angle ? value + 0.05 * side : value + 0.05 * side * std::fabs(value);
  bound = std::max(bound, least);
  if (is_angle) bound = std::min(bound, std::max(value, 1.55));
  return optimizer::with_bound(changed, name, bound);
}

/// The ends and all that lies between them, read from coordinates around (east, up) and rounded as those are.
inline Problem moved(Problem problem, double east, double up) {
  problem = lifted(std::move(problem), up);
  const auto move = [&](double& run) { run = (east + run) - east; };
  move(problem.endpoints.run);
  Limits& limits = problem.limits;
  for (HalfPlane& plane : limits.half_planes) move(plane.point.x);
  for (KeepOut& area : limits.keep_outs) {
    for (Vec2& point : area.outline) move(point.x);
  }
  for (std::vector<Profile>* profiles : {&limits.stay_above, &limits.stay_below}) {
    for (Profile& profile : *profiles) {
      for (Vec2& point : profile.line) move(point.x);
    }
  }
  for (Vec2& point : limits.waypoints) {
    move(point.x);
    point.y = up - (up - point.y);
  }
  return problem;
}

inline std::vector<Variation> relaxations_of(const Problem& problem) {
  std::vector<Variation> variations;
  for (const LimitName& name : limits_of(problem)) {
    variations.push_back({"without", name.key(), Order::no_worse, without(problem, name)});
    if (auto changed = wider(problem, name)) {
      variations.push_back({"wider", name.key(), Order::no_worse, *std::move(changed)});
    }
  }
  if (problem.low_friction || problem.high_friction) {
    Problem narrow = problem;
    const double mu = problem.body.friction.coefficient();
    for (std::optional<Friction>* end : {&narrow.low_friction, &narrow.high_friction}) {
      if (*end) *end = Friction::from_coefficient(0.5 * (mu + (*end)->coefficient()));
    }
    variations.push_back({"narrower friction", "", Order::no_worse, narrow});
    narrow.low_friction.reset();
    narrow.high_friction.reset();
    variations.push_back({"one friction", "", Order::no_worse, narrow});
  }
  return variations;
}

inline std::vector<Variation> same_again(const Problem& problem) {
  std::vector<Variation> variations;
  Problem mirrored = problem;
  mirrored.endpoints.run = -mirrored.endpoints.run;
  variations.push_back({"mirrored", "", Order::same, mirrored});
  variations.push_back({"moved 4 km", "", Order::same, moved(problem, 4e3, 4e3)});
  variations.push_back({"moved 5,000 km", "", Order::same, moved(problem, 5e6, 4e3)});
  for (const double size : {1e-2, 1e3}) {
    const double root = std::sqrt(size);
    const std::string name = size < 1.0 ? "scaled 1e-2" : "scaled 1e3";
    variations.push_back({name, "", Order::same, resized(problem, size), root, root});
  }
  return variations;
}

/// What a report says would do, put in.
inline std::vector<Variation> as_advised(const Problem& problem, const OptimizeReport& report) {
  std::vector<Variation> variations;
  for (const Relaxation& relaxation : report.conflict.relaxations) {
    // An obstacle that has to move itself.
    if (relaxation.needed < 0.0 && relaxation.limit.dimension() == Dimension::length) continue;
    if (auto changed = optimizer::with_bound(problem, relaxation.limit, relaxation.needed)) {
      variations.push_back({"needed", relaxation.limit.key(), Order::solves, *std::move(changed)});
    }
  }
  return variations;
}

/// A cap on the speed, from close to what the straight line reaches down to far below it, with few other limits.
inline Problem capped(testing::Random& random) {
  Problem problem = drawn(random);
  problem.limits = Limits{};
  const auto chance = [&](double share) { return random.between(0.0, 1.0) < share; };
  const double chord = std::hypot(problem.endpoints.run, problem.endpoints.drop);
  const double entry = problem.body.entry_speed;
  const double fall = problem.endpoints.drop - problem.body.friction.coefficient() * problem.endpoints.run;
  const double straight = std::sqrt(entry * entry + 2.0 * problem.gravity * std::max(fall, 0.02 * chord));
  problem.limits.speed.highest = std::max(straight * random.between(0.75, 1.05), 1.05 * entry);
  if (chance(0.3)) problem.limits.smallest_valley_radius = chord * random.between(0.02, 0.3);
  if (chance(0.3)) problem.limits.smallest_crest_radius = chord * random.between(0.02, 0.3);
  if (chance(0.3)) problem.limits.highest_normal_load = problem.gravity * random.between(1.2, 2.5);
  return problem;
}

/// The kinds of problems that are drawn.
inline constexpr std::array<std::string_view, 4> kDraws{"usual", "every kind of limit", "solids",
                                                        "speed caps"};

/// @param index  of the problem; each has random numbers of its own
/// @param draw   out: index into kDraws
inline Problem problem_to_vary(std::uint64_t seed, int index, std::size_t& draw) {
  testing::Random random(1000003 * seed + static_cast<std::uint64_t>(index));
  const double share = random.between(0.0, 1.0);
  draw = share < 0.55 ? 0 : share < 0.75 ? 1 : share < 0.88 ? 2 : 3;
  Problem problem = draw == 0   ? drawn(random)
                    : draw == 1 ? random_limited(random)
                    : draw == 2 ? random_case(random).problem
                                : capped(random);
  // A report tells the time at the body's own friction.
  problem.objective.worst_case = false;
  return problem;
}

}  // namespace glissade::testing_problems
