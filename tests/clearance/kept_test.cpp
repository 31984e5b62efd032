// Everything that is called kept, held against the mesh of the solid built along the track: random sections,
// limits and obstacles, by brute force.

#include "glissade/core/error.hpp"
#include "glissade/optimize/optimize.hpp"
#include "glissade/solid/sweep.hpp"

#include "clearance/random_case.hpp"
#include "support/catch.hpp"
#include "support/mesh_clearance.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

using namespace glissade;

namespace {

constexpr double kTolerance = 2e-3;  // of the meshes

int problem_count() {
  const char* const asked = std::getenv("GLISSADE_PROBLEMS");
  if (asked != nullptr) return std::max(1, std::atoi(asked));
  return testing::thorough() ? 40 : 14;
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

/// What slides, as thin as a hair, at many places: nothing of the solid cuts it.
testing::SideView sliding(const Centerline& track, double headroom) {
  constexpr int kPlaces = 1500;
  testing::SideView facets;
  for (int i = 0; i <= kPlaces; ++i) {
    const CenterlinePoint at = track.at(std::min(track.length(), track.length() * i / kPlaces));
    const Vec2 foot{at.x, at.drop};
    const Vec2 normal{std::sin(at.slope_angle), -std::cos(at.slope_angle)};
    facets.push_back({foot, foot + headroom * normal, foot + 0.5 * headroom * normal});
  }
  return facets;
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
  int leaning = 0;
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
    const double headroom = made.problem.limits.envelope.headroom;
    if (headroom > 0.0) {
      const double size = norm(Vec2{made.problem.endpoints.run, made.problem.endpoints.drop});
      check_mesh(sliding(*optimum.centerline, headroom), made.problem.limits, 1e-6 * size);
      ++leaning;
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
  CHECK(leaning > problem_count() / 10);
  CHECK(none <= problem_count() / 20);
}
