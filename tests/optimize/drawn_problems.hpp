#pragma once

#include "glissade/optimize/optimize.hpp"

#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

namespace glissade::testing_problems {

/// A problem as a user would pose it: a run of 3 to 60 m, one to four limits, with and without entry speed, drag and a
/// friction range.
inline Problem drawn(testing::Random& random) {
  const auto chance = [&](double share) { return random.between(0.0, 1.0) < share; };
  const auto rounded = [](double value, double step) { return std::round(value / step) * step; };
  Problem problem;
  const double mu = rounded(random.between(0.0, 0.5), 0.01);
  const double ratio = std::exp(random.between(std::log(std::max(1.2 * mu, 0.15)), std::log(2.0)));
  const double run = rounded(3.0 * std::pow(20.0, random.between(0.0, 1.0)), 0.1);
  const double drop = rounded(ratio * run, 0.1);
  problem.endpoints = {run, drop};
  problem.body.friction = Friction::from_coefficient(mu);
  const double chord = std::hypot(run, drop);
  const double gravity = problem.gravity;
  const double fall_speed = std::sqrt(gravity * chord);
  const double mean = std::atan2(drop, run);
  if (chance(0.35)) problem.body.entry_speed = rounded(random.between(0.05, 0.8) * fall_speed, 0.1);
  if (chance(0.25)) problem.body.drag_per_metre = random.between(0.01, 0.3) / chord;
  if (chance(0.25) && mu > 0.0 && drop > 1.16 * mu * run) {
    problem.low_friction = Friction::from_coefficient(0.85 * mu);
    problem.high_friction = Friction::from_coefficient(1.1 * mu);
  }
  Limits& limits = problem.limits;
  const std::vector<std::function<void()>> kinds = {
      [&] { limits.slope_angle.highest = std::min(1.5, mean + random.between(0.05, 0.6)); },
      [&] { limits.slope_angle.lowest = std::min(mean - 0.05, random.between(-0.3, std::atan(mu) + 0.1)); },
      [&] {
        const double angle = mean + random.between(-0.5, 0.2);
        limits.exit_slope_angle = chance(0.5) ? Range::fixed(angle) : Range{angle - 0.1, angle + 0.1};
      },
      [&] { limits.entry_slope_angle = Range::fixed(mean + random.between(0.0, 0.4)); },
      [&] { limits.smallest_valley_radius = chord * random.between(0.1, 1.5); },
      [&] { limits.smallest_crest_radius = chord * random.between(0.1, 1.5); },
      [&] { limits.highest_normal_load = gravity * random.between(1.2, 2.5); },
      [&] { limits.speed.highest = fall_speed * random.between(0.7, 1.3); },
      [&] { limits.lead_out = chord * random.between(0.02, 0.15); },
      [&] {
        limits.half_planes.push_back({{0.0, random.between(0.02, 0.12) * chord}, {-drop / run, 1.0}, 0.0});
      },
      [&] {
        limits.stay_above.push_back({{{0.0, 0.05 * chord},
                                      {0.3 * run, 0.3 * drop + random.between(0.03, 0.15) * chord},
                                      {0.6 * run, 0.6 * drop + random.between(0.03, 0.15) * chord},
                                      {run, drop + 0.03 * chord}},
                                     0.01 * chord});
      },
      [&] { limits.highest_curvature_rate = random.between(3.0, 30.0) / (chord * chord); },
      [&] { limits.lowest_normal_load = gravity * random.between(0.05, 0.5); },
      [&] { limits.lead_in = chord * random.between(0.02, 0.15); },
      [&] { limits.arc_length.highest = chord * random.between(1.02, 1.2); },
  };
  std::vector<bool> taken(kinds.size(), false);
  for (int wanted = random.integer(1, 4); wanted > 0;) {
    const auto kind = static_cast<std::size_t>(random.integer(0, static_cast<int>(kinds.size()) - 1));
    if (taken[kind]) continue;
    taken[kind] = true;
    kinds[kind]();
    --wanted;
  }
  if (chance(0.06)) problem.objective.kind = ObjectiveKind::exit_speed;
  return problem;
}

/// The same problem, every length `size` times as long; times and speeds go with the root of that.
inline Problem resized(Problem problem, double size) {
  const auto scale = [&](std::optional<double>& value, double factor) {
    if (value) *value *= factor;
  };
  const double root = std::sqrt(size);
  problem.endpoints = {problem.endpoints.run * size, problem.endpoints.drop * size};
  problem.body.entry_speed *= root;
  problem.body.drag_per_metre /= size;
  Limits& limits = problem.limits;
  scale(limits.smallest_valley_radius, size);
  scale(limits.smallest_crest_radius, size);
  scale(limits.highest_curvature_rate, 1.0 / (size * size));
  for (Range* range : {&limits.speed, &limits.exit_speed}) {
    scale(range->lowest, root);
    scale(range->highest, root);
  }
  for (Range* range : {&limits.arc_length, &problem.finish.free_range, &problem.finish.free_drop}) {
    scale(range->lowest, size);
    scale(range->highest, size);
  }
  limits.lead_in *= size;
  limits.lead_out *= size;
  limits.lowest_speed_from *= size;
  for (HalfPlane& plane : limits.half_planes) {
    plane.clearance *= size;
    plane.point = size * plane.point;
  }
  for (KeepOut& area : limits.keep_outs) {
    area.clearance *= size;
    for (Vec2& point : area.outline) point = size * point;
  }
  for (std::vector<Profile>* profiles : {&limits.stay_above, &limits.stay_below}) {
    for (Profile& profile : *profiles) {
      profile.clearance *= size;
      for (Vec2& point : profile.line) point = size * point;
    }
  }
  for (Vec2& point : limits.waypoints) point = size * point;
  const Envelope& envelope = limits.envelope;
  limits.envelope = {size * envelope.below, size * envelope.above, size * envelope.headroom};
  return problem;
}

/// The same problem as read from heights around `height`, rounded as those are.
inline Problem lifted(Problem problem, double height) {
  const auto move = [&](double& drop) { drop = height - (height - drop); };
  move(problem.endpoints.drop);
  for (HalfPlane& plane : problem.limits.half_planes) move(plane.point.y);
  for (KeepOut& area : problem.limits.keep_outs) {
    for (Vec2& point : area.outline) move(point.y);
  }
  for (std::vector<Profile>* profiles : {&problem.limits.stay_above, &problem.limits.stay_below}) {
    for (Profile& profile : *profiles) {
      for (Vec2& point : profile.line) move(point.y);
    }
  }
  return problem;
}

}  // namespace glissade::testing_problems
