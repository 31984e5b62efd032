// Everything that is called kept, held against the mesh of the solid built along the track: random sections,
// limits and obstacles, by brute force.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/solid/sweep.hpp"

#include "clearance/random_section.hpp"
#include "support/catch.hpp"
#include "support/mesh_clearance.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

using namespace glissade;

namespace {

constexpr double kTolerance = 2e-3;  // of the meshes

int problem_count() {
  const char* const asked = std::getenv("GLISSADE_PROBLEMS");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 40;
}

struct RandomCase {
  Problem problem;
  CrossSection section = CrossSection::slab(1.0, 0.1);
  std::string words;
};

/// Obstacles beside the fastest track of all: some in its way, some for its walls alone, some before its start and
/// some past its finish.
RandomCase random_case(testing::Random& random) {
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
        {{at, at + Vec2{wide, random.between(-0.1, 0.1)}, at + Vec2{wide, high}, at + Vec2{0.0, high}},
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

/// Every clearance of the limits, on the mesh: what it lacks beyond `slack`.
void check_mesh(const testing::SideView& facets, const Limits& limits, double slack) {
  for (const HalfPlane& plane : limits.half_planes) {
    double least = INFINITY;
    for (const auto& facet : facets) {
      for (const Vec2 point : facet) {
        least = std::min(least, -dot(point - plane.point, plane.forbidden) / norm(plane.forbidden));
      }
    }
    CHECK(least >= plane.clearance - slack);
  }
  for (const KeepOut& area : limits.keep_outs) {
    CHECK(testing::mesh_distance(facets, area.outline, true) >= area.clearance - slack);
  }
  for (const auto* lines : {&limits.stay_above, &limits.stay_below}) {
    const double side = lines == &limits.stay_above ? 1.0 : -1.0;
    for (const Profile& profile : *lines) {
      CHECK(testing::mesh_distance(facets, profile.line, false) >= profile.clearance - slack);
      for (const auto& facet : facets) {
        for (const Vec2 point : facet) {
          for (std::size_t i = 0; i + 1 < profile.line.size(); ++i) {
            const Vec2 a = profile.line[i];
            const Vec2 b = profile.line[i + 1];
            if (point.x < a.x || point.x > b.x) continue;
            const double drop = a.y + (b.y - a.y) * (point.x - a.x) / (b.x - a.x);
            if (side * (point.y - drop) > slack) FAIL_CHECK("a facet lies behind a line");
          }
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("clearances: whatever is called kept, the mesh of the solid keeps") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int kept = 0;
  int built = 0;
  int bound = 0;
  int infeasible = 0;
  int none = 0;
  int relaxed = 0;
  for (int i = 0; i < problem_count(); ++i) {
    const RandomCase made = random_case(random);
    INFO("case " << i << ": " << made.words);
    const Optimum optimum = optimize(made.problem);
    if (!optimum.centerline) {
      ++(optimum.report.status == OptimizeStatus::infeasible ? infeasible : none);
      if (std::getenv("GLISSADE_TABLE")) WARN(i << ": " << optimum.report.message);
      continue;
    }
    ++kept;
    for (const ActiveLimit& active : optimum.report.active) {
      if (active.limit.id >= LimitId::half_planes && active.limit.id <= LimitId::stay_below) {
        ++bound;
        break;
      }
    }
    if (optimum.report.status == OptimizeStatus::optimal && random.integer(0, 2) == 0) {
      // Less of a solid has more room.
      Problem lower = made.problem;
      Envelope& envelope = lower.limits.envelope;
      envelope = {0.6 * envelope.below, 0.6 * envelope.above, 0.6 * envelope.headroom};
      const Optimum easier = optimize(lower);
      CHECK(easier.centerline);
      if (easier.centerline) CHECK(easier.report.travel_time <= optimum.report.travel_time * (1.0 + 1e-5));
      ++relaxed;
    }
    SweepOptions options;
    options.tolerance = kTolerance;
    options.shape_triangles = 500;
    Solid solid;
    try {
      solid = sweep(*optimum.centerline, made.section, Placement(), options);
    } catch (const InputError&) {
      continue;  // such a section cannot follow such a track: nothing is built
    }
    ++built;
    check_mesh(
        testing::side_view(solid.mesh, Placement()), made.problem.limits,
        solid.max_deviation + 1e-6 * norm(Vec2{made.problem.endpoints.run, made.problem.endpoints.drop}));
  }
  CAPTURE(kept, built, bound, infeasible, none);
  if (std::getenv("GLISSADE_TABLE"))
    WARN("kept " << kept << ", built " << built << ", bound " << bound << ", infeasible " << infeasible
                 << ", none " << none);
  CHECK(built > problem_count() / 3);
  CHECK(bound > problem_count() / 4);
  CHECK(relaxed > problem_count() / 10);
  CHECK(none <= problem_count() / 20);
}
