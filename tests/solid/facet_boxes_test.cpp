// The tree of boxes against a look at all pairs.

#include "solid/facet_boxes.hpp"

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/sweep.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

using namespace glissade;
using solid::FacetBoxes;
using solid::FacetCorners;

namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

struct Soup {
  std::vector<Vec3> positions;
  std::vector<FacetCorners> facets;
};

/// Long thin facets, each turned its own way where `turned`, else all about the same one.
Soup slivers(testing::Random& random, int count, double scale, Vec3 origin, bool turned) {
  Soup soup;
  const auto direction = [&random] {
    return Vec3{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
  };
  const Vec3 common = direction();
  for (int i = 0; i < count; ++i) {
    const Vec3 along = turned ? direction() : common + 1e-3 * direction();
    const Vec3 corner = origin + scale * direction();
    soup.positions.insert(soup.positions.end(),
                          {corner, corner + scale * along, corner + 1e-3 * scale * direction()});
    const auto first = static_cast<std::uint32_t>(3 * i);
    soup.facets.push_back({first, first + 1, first + 2});
  }
  return soup;
}

std::set<Pair> found_pairs(const Soup& soup) {
  std::set<Pair> pairs;
  FacetBoxes(soup.positions, soup.facets)
      .for_each_pair(
          [&pairs](std::uint32_t a, std::uint32_t b) {
            CHECK(a != b);
            CHECK(pairs.insert(std::minmax(a, b)).second);  // each once
          },
          [] {});
  return pairs;
}

/// @return whether a point of one facet, on a grid, lies within a tiny distance of a point of the other
bool surely_meet(const Soup& soup, const FacetCorners& a, const FacetCorners& b) {
  // Facets that share a corner do.
  return std::any_of(a.begin(), a.end(), [&](std::uint32_t mine) {
    return std::any_of(b.begin(), b.end(),
                       [&](std::uint32_t other) { return soup.positions[mine] == soup.positions[other]; });
  });
}

}  // namespace

TEST_CASE(
    "facet boxes: facets with a point in common are always a pair, wherever and however large they are") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const double scale : {1e-150, 1e-3, 1.0, 1e59}) {
    for (const Vec3 origin : {Vec3{}, scale * Vec3{1e6, -3e6, 2e5}}) {
      if (scale > 1e50 && !(origin == Vec3{})) continue;
      for (const bool turned : {false, true}) {
        Soup soup = slivers(random, 300, scale, origin, turned);
        // Every third facet begins where another one has a corner.
        for (std::size_t i = 3; i < soup.facets.size(); i += 3) {
          const auto other = static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1));
          soup.positions[3 * i] = soup.positions[3 * other + static_cast<std::size_t>(random.integer(0, 2))];
        }
        const std::set<Pair> pairs = found_pairs(soup);
        for (std::uint32_t i = 0; i < soup.facets.size(); ++i) {
          for (std::uint32_t k = i + 1; k < soup.facets.size(); ++k) {
            if (surely_meet(soup, soup.facets[i], soup.facets[k])) CHECK(pairs.contains({i, k}));
          }
        }
      }
    }
  }
}

TEST_CASE("facet boxes: crossing slivers are found at every angle") {
  for (int degrees = 0; degrees < 180; degrees += 7) {
    const double angle = degrees * 3.14159265358979 / 180.0;
    const Vec3 along{std::cos(angle), std::sin(angle), 0.3};
    Soup soup;
    // A fan of parallel slivers, and one that runs through the middle of each.
    for (int i = 0; i < 200; ++i) {
      const Vec3 base = static_cast<double>(i) * Vec3{-1e-3 * along.y, 1e-3 * along.x, 0.0};
      soup.positions.insert(soup.positions.end(),
                            {base - along, base + along, base + 1e-4 * Vec3{0.0, 0.0, 1.0}});
      soup.facets.push_back({static_cast<std::uint32_t>(3 * i), static_cast<std::uint32_t>(3 * i + 1),
                             static_cast<std::uint32_t>(3 * i + 2)});
    }
    const Vec3 across{-along.y, along.x, 0.0};
    soup.positions.insert(soup.positions.end(), {-1.0 * across, 1.0 * across, {0.0, 0.0, -0.1}});
    soup.facets.push_back({600, 601, 602});
    const std::set<Pair> pairs = found_pairs(soup);
    for (std::uint32_t i = 0; i < 200; ++i) CHECK(pairs.contains({i, 200}));
    CHECK(pairs.size() < 3000);
  }
}

TEST_CASE("facet boxes: a sweep has few pairs a facet, flat, wide or thin, along an axis or across them") {
  struct Task {
    CrossSection section;
    double tolerance;
  };
  const std::vector<Task> tasks{{CrossSection::u_channel(0.4, 0.25, 0.004), 1e-5},
                                {CrossSection::u_channel(30.0, 0.25, 0.004), 1e-6},
                                {CrossSection::u_channel(30.0, 0.25, 0.004), 5e-4},
                                {CrossSection::slab(40.0, 1e-4), 5e-4},
                                {CrossSection::slab(0.4, 1e-5), 5e-4},
                                {CrossSection::pipe(0.4, 0.004), 1e-5}};
  const CoulombBrachistochrone track(Endpoints{2.4, 1.8}, Friction::from_coefficient(0.2));
  for (const Task& task : tasks) {
    for (const double azimuth : {0.0, 45.0, 77.0}) {
      SweepOptions options;
      options.tolerance = task.tolerance;
      options.shape_triangles = 50'000;
      const Solid swept =
          sweep(track, task.section, Placement({0.0, 0.0, 0.0}, Angle::from_degrees(azimuth)), options);
      std::size_t pairs = 0;
      FacetBoxes(swept.mesh.vertices, swept.mesh.triangles)
          .for_each_pair([&pairs](std::uint32_t, std::uint32_t) { ++pairs; }, [] {});
      INFO(task.section.kind() << ", tolerance " << task.tolerance << ", azimuth " << azimuth << ", "
                               << swept.mesh.triangles.size() << " facets");
      // Some seven where facets are as good as can be.
      CHECK(pairs < 14 * swept.mesh.triangles.size());
    }
  }
}

TEST_CASE("measure: ends when it is asked to") {
  const CoulombBrachistochrone track(Endpoints{2.4, 1.8}, Friction::from_coefficient(0.2));
  const Solid swept = sweep(track, CrossSection::pipe(0.4, 0.004), Placement());
  std::stop_source source;
  CHECK(measure(swept.mesh, source.get_token()).valid());
  source.request_stop();
  CHECK_THROWS_AS(measure(swept.mesh, source.get_token()), Interrupted);
}
