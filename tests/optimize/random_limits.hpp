#pragma once

#include "glissade/optimize/optimize.hpp"

#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>

namespace glissade::testing_problems {

/// A problem with a random mixture of every kind of limit, over four orders of magnitude in size. Most can be
/// solved; some contradict themselves.
inline Problem random_limited(testing::Random& random) {
  const auto chance = [&](double share) { return random.between(0.0, 1.0) < share; };
  Problem problem;
  const double mu = random.between(0.0, 0.6);
  const double ratio = std::exp(random.between(std::log(std::max(1.15 * mu, 0.15)), std::log(2.0)));
  const double run = std::pow(10.0, random.between(-1.0, 3.0));
  problem.endpoints = {run, ratio * run};
  problem.body.friction = Friction::from_coefficient(mu);
  const double chord = std::hypot(run, ratio * run);
  const double gravity = problem.gravity;
  const double fall_speed = std::sqrt(gravity * chord);
  const double mean = std::atan(ratio);
  Limits& limits = problem.limits;
  if (chance(0.2)) problem.body.entry_speed = random.between(0.05, 0.8) * fall_speed;
  if (chance(0.2)) problem.body.drag_per_metre = random.between(0.01, 0.3) / chord;
  if (chance(0.35)) limits.slope_angle.highest = std::min(1.5, mean + random.between(0.05, 0.6));
  if (chance(0.2)) limits.slope_angle.lowest = std::min(mean - 0.05, random.between(-0.3, std::atan(mu)));
  if (chance(0.3)) {
    const double angle = mean + random.between(-0.5, 0.2);
    limits.exit_slope_angle = chance(0.5) ? Range::fixed(angle) : Range{angle - 0.1, angle + 0.1};
  }
  if (chance(0.15)) limits.entry_slope_angle = Range::fixed(mean + random.between(0.0, 0.4));
  if (chance(0.3)) limits.smallest_valley_radius = chord * random.between(0.1, 1.5);
  if (chance(0.2)) limits.smallest_crest_radius = chord * random.between(0.1, 1.5);
  if (chance(0.1)) limits.concave = true;
  if (chance(0.1)) limits.highest_curvature_rate = random.between(3.0, 30.0) / (chord * chord);
  if (chance(0.25)) limits.highest_normal_load = gravity * random.between(1.2, 2.5);
  if (chance(0.1)) limits.highest_curvature_load = gravity * random.between(0.3, 1.5);
  if (chance(0.25)) limits.speed.highest = fall_speed * random.between(0.7, 1.3);
  if (chance(0.1)) {
    limits.speed.lowest = fall_speed * random.between(0.05, 0.3);
    limits.lowest_speed_from = 0.3 * chord;
  }
  if (chance(0.1)) limits.exit_speed.highest = fall_speed * random.between(0.5, 1.2);
  if (chance(0.1)) limits.arc_length.highest = chord * random.between(1.02, 1.2);
  if (chance(0.15)) limits.lead_in = chord * random.between(0.02, 0.15);
  if (chance(0.15)) limits.lead_out = chord * random.between(0.02, 0.15);
  if (chance(0.2)) {
    limits.half_planes.push_back({{0.0, random.between(0.02, 0.12) * chord}, {-ratio, 1.0}, 0.0});
  }
  if (chance(0.15)) {
    const double x = random.between(0.3, 0.6) * run;
    const double y = ratio * x + random.between(-0.05, 0.25) * chord;
    const double wide = 0.08 * chord;
    const double high = 0.06 * chord;
    limits.keep_outs.push_back(
        {{{x, y}, {x + wide, y}, {x + wide, y + high}, {x, y + high}}, 0.02 * chord, Passage::either});
  }
  if (chance(0.12)) {
    limits.stay_above.push_back({{{0.0, 0.05 * chord},
                                  {0.3 * run, 0.3 * ratio * run + random.between(0.03, 0.15) * chord},
                                  {0.6 * run, 0.6 * ratio * run + random.between(0.03, 0.15) * chord},
                                  {run, ratio * run + 0.03 * chord}},
                                 0.01 * chord});
  }
  if (chance(0.08)) {
    limits.waypoints.push_back({0.5 * run, 0.5 * ratio * run + random.between(0.0, 0.15) * chord});
  }
  if (chance(0.15)) {
    problem.low_friction = Friction::from_coefficient(0.85 * mu);
    problem.high_friction = Friction::from_coefficient(1.1 * mu);
  }
  if (chance(0.1)) {
    problem.finish.kind = FinishKind::vertical_line;
    problem.finish.free_range = {0.8 * ratio * run, 1.2 * ratio * run};
  } else if (chance(0.08)) {
    problem.finish.kind = FinishKind::level;
    problem.finish.free_range = {0.8 * run, 1.2 * run};
  }
  if (chance(0.08)) {
    limits.stay_below.push_back({{{0.2 * run, 0.2 * ratio * run - 0.02 * chord},
                                  {0.5 * run, 0.5 * ratio * run + random.between(-0.05, 0.1) * chord},
                                  {0.8 * run, 0.8 * ratio * run - 0.02 * chord}},
                                 0.005 * chord});
  }
  if (chance(0.08)) limits.lowest_normal_load = gravity * random.between(0.05, 0.5);
  if (chance(0.05) && !limits.arc_length.limited()) {
    limits.arc_length.lowest = chord * random.between(1.02, 1.15);
  }
  if (chance(0.05) && !limits.exit_speed.limited()) {
    limits.exit_speed.lowest = fall_speed * random.between(0.2, 0.6);
  }
  if (chance(0.05)) {
    problem.objective.kind = ObjectiveKind::exit_speed;
  } else if (chance(0.05)) {
    problem.objective.kind = ObjectiveKind::blend;
    problem.objective.exit_speed_weight = random.between(0.1, 1.0) / gravity;
  }
  if (chance(0.1)) problem.objective.worst_case = true;
  if (chance(0.2)) problem.endpoints.run = -run;
  return problem;
}

/// How many random problems a test takes: GLISSADE_PROBLEMS of the environment; where that is not set 150 in continuous
/// integration, 24 elsewhere and in a build without optimisation.
inline int problem_count() {
  const char* const asked = std::getenv("GLISSADE_PROBLEMS");
  if (asked != nullptr) return std::max(1, std::atoi(asked));
#ifdef NDEBUG
  return testing::thorough() ? 150 : 24;
#else
  return 24;
#endif
}

/// What a short run draws them with.
inline constexpr std::uint64_t kShortSeed = 8;

/// What random limited problems are drawn with. The first one of those that continuous integration draws winds at a cap on
/// the speed, which takes half a minute; of the others none takes long, and some contradict themselves.
inline testing::Random seeded_for_limited() {
  return testing::thorough() ? testing::seeded_random() : testing::seeded_random(kShortSeed);
}

}  // namespace glissade::testing_problems
