#pragma once

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/optimize/optimize.hpp"

#include "clearance/random_section.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace glissade {

/// A problem with clearances for a whole solid, and the section that the solid has.
struct RandomCase {
  Problem problem;
  CrossSection section = CrossSection::slab(1.0, 0.1);
  std::string words;
};

/// Obstacles beside the fastest track of all: some in its way, some for its walls alone, some before its start and
/// some past its finish.
inline RandomCase random_case(testing::Random& random) {
  RandomCase made;
  std::ostringstream words;
  words.precision(17);
  const auto chance = [&](double share) { return random.between(0.0, 1.0) < share; };
  const double run = random.between(3.0, 12.0);
  const double mu = random.between(0.0, 0.4);
  const double drop = run * (1.2 * mu + random.between(0.2, 1.2));
  Problem& problem = made.problem;
  problem.endpoints = {run, drop};
  problem.body.friction = Friction::from_coefficient(mu);
  if (chance(0.3)) problem.body.entry_speed = random.between(0.5, 4.0);
  if (chance(0.3)) problem.high_friction = Friction::from_coefficient(1.1 * mu);
  words << "run " << run << ", drop " << drop << ", mu " << mu << ", entry " << problem.body.entry_speed
        << "; ";
  made.section = random_section(random, words);
  Limits& limits = problem.limits;
  if (chance(0.5)) limits.slope_angle.highest = std::atan(drop / run) + random.between(0.2, 0.6);
  if (chance(0.5)) limits.smallest_valley_radius = random.between(0.3, 2.0);
  if (chance(0.3)) limits.smallest_crest_radius = random.between(0.3, 2.0);
  if (chance(0.2)) limits.lead_in = random.between(0.1, 0.5);
  if (chance(0.2)) limits.lead_out = random.between(0.1, 0.5);
  limits.envelope = {-made.section.lowest(), made.section.highest(),
                     chance(0.3) ? random.between(0.1, 1.0) : 0.0};
  const CoulombBrachistochrone fastest(problem.endpoints, problem.body.friction);
  const auto beside = [&](double reach) {
    const CenterlinePoint at = fastest.at(random.between(0.0, 1.0) * fastest.length());
    return Vec2{at.x, at.drop} +
           random.between(-reach, reach) * Vec2{std::sin(at.slope_angle), -std::cos(at.slope_angle)};
  };
  const double reach = limits.envelope.top() + 0.5;
  for (int i = random.integer(0, 2); i > 0; --i) {
    const Vec2 at = beside(reach);
    const double wide = random.between(0.05, 0.5);
    const double high = random.between(0.05, 0.5);
    const Passage passes[] = {Passage::either, Passage::either, Passage::above, Passage::below};
    limits.keep_outs.push_back(
        // Its sides do not cross.
        {{at, at + Vec2{wide, std::min(random.between(-0.1, 0.1), 0.9 * high)}, at + Vec2{wide, high},
          at + Vec2{0.0, high}},
         random.between(0.0, 0.15),
         passes[random.integer(0, 3)]});
    words << " keep-out " << at.x << " " << at.y << " " << wide << " x " << high << ";";
  }
  if (chance(0.3)) {
    const double angle = random.between(-0.7, 0.7);
    limits.half_planes.push_back({{run * random.between(-0.1, 0.3), -random.between(0.8, 2.0)},
                                  {std::sin(angle), -std::cos(angle)},
                                  random.between(0.0, 0.1)});
  }
  if (chance(0.4)) {
    std::vector<Vec2> line;
    for (int k = 0; k <= 4; ++k) {
      const double x = run * (0.3 * k - 0.1);
      line.push_back({x, std::clamp(x / run, 0.0, 1.0) * drop + random.between(0.1, 0.5) * drop});
    }
    limits.stay_above.push_back({line, random.between(0.0, 0.1)});
  }
  if (chance(0.3)) {
    std::vector<Vec2> line;
    for (int k = 0; k <= 3; ++k) {
      const double x = run * (0.4 * k - 0.1);
      line.push_back({x, std::clamp(x / run, 0.0, 1.0) * drop - random.between(0.9, 2.5)});
    }
    limits.stay_below.push_back({line, random.between(0.0, 0.1)});
  }
  if (chance(0.2)) {
    const double past = random.between(0.05, 0.6);
    limits.keep_outs.push_back({{{run + past, drop - 0.6},
                                 {run + past + 0.2, drop - 0.6},
                                 {run + past + 0.2, drop + 0.4},
                                 {run + past, drop + 0.4}},
                                random.between(0.0, 0.1),
                                Passage::either});
  }
  if (chance(0.2)) {
    const double above = random.between(0.05, 0.6);
    limits.keep_outs.push_back({{{-0.3, -above - 0.2}, {0.5, -above - 0.2}, {0.5, -above}, {-0.3, -above}},
                                random.between(0.0, 0.1),
                                Passage::either});
  }
  made.words = words.str();
  return made;
}

}  // namespace glissade
