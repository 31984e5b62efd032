// triangulate_loops() against what defines a constrained Delaunay triangulation, checked on every facet.

#include "solid/cap_triangulation.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

using namespace glissade;
using solid::triangulate_loops;

namespace {

using Loop = std::vector<Vec2>;
using Loops = std::vector<Loop>;
using Facet = std::array<std::uint32_t, 3>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Vec2> points_of(const Loops& loops) {
  std::vector<Vec2> points;
  for (const Loop& loop : loops) points.insert(points.end(), loop.begin(), loop.end());
  return points;
}

double area_of(const Loop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    twice += cross(loop[i] - loop[0], loop[(i + 1) % loop.size()] - loop[0]);
  }
  return 0.5 * twice;
}

std::set<Edge> edges_of(const Loops& loops) {
  std::set<Edge> edges;
  std::uint32_t first = 0;
  for (const Loop& loop : loops) {
    const auto count = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < count; ++i) edges.insert(std::minmax(first + i, first + (i + 1) % count));
    first += count;
  }
  return edges;
}

/// @return how far a point lies within the circle through three others, as a share of its squared radius
double depth_in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  const double twice = 2.0 * cross(ab, ac);
  const Vec2 centre{(ac.y * dot(ab, ab) - ab.y * dot(ac, ac)) / twice,
                    (ab.x * dot(ac, ac) - ac.x * dot(ab, ab)) / twice};
  const Vec2 to_p = (p - a) - centre;
  return 1.0 - dot(to_p, to_p) / dot(centre, centre);
}

void check_triangulation(const Loops& loops) {
  const std::vector<Vec2> points = points_of(loops);
  const std::vector<Facet> facets = triangulate_loops(loops);
  REQUIRE(facets.size() == points.size() + 2 * loops.size() - 4);
  double area = 0.0;
  double expected = 0.0;
  for (const Loop& loop : loops) expected += area_of(loop);
  std::set<Edge> directed;
  for (const auto& [a, b, c] : facets) {
    const double twice = cross(points[b] - points[a], points[c] - points[a]);
    CHECK(twice > 0.0);
    area += 0.5 * twice;
    for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) CHECK(directed.insert(edge).second);
  }
  CHECK(std::fabs(area - expected) <= 1e-12 * std::fabs(expected));
  // The surface ends at the edges of the loops alone, and is locally Delaunay at all others.
  const std::set<Edge> fixed = edges_of(loops);
  for (const auto& [a, b, c] : facets) {
    for (const auto& [from, to] : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
      const bool has_neighbour = directed.contains({to, from});
      CHECK(has_neighbour == !fixed.contains(std::minmax(from, to)));
      if (!has_neighbour) continue;
      for (const auto& other : facets) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (other[i] != to || other[(i + 1) % 3] != from) continue;
          CHECK(depth_in_circle(points[a], points[b], points[c], points[other[(i + 2) % 3]]) <= 1e-7);
        }
      }
    }
  }
}

/// A loop around a point whose distance from it goes up and down at random.
Loop star(testing::Random& random, Vec2 centre, double size, int corners) {
  Loop loop;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    const double radius = size * random.between(0.3, 1.0);
    loop.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return loop;
}

std::string refusal(const Loops& loops) {
  try {
    static_cast<void>(triangulate_loops(loops));
  } catch (const InternalError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("end faces: random outlines are filled by their constrained Delaunay triangulation") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 60; ++i) {
    Loops loops{star(random, {0.0, 0.0}, 1.0, random.integer(3, 80))};
    if (i % 2 == 0 && loops[0].size() > 8) {
      Loop hole = star(random, {0.01, -0.02}, 0.15, random.integer(3, 20));
      std::reverse(hole.begin(), hole.end());
      loops.push_back(std::move(hole));
    }
    check_triangulation(loops);
  }
}

TEST_CASE("end faces: a U whose plates are cut into many pieces, and a ring of concentric circles") {
  Loop u;
  constexpr int kPieces = 200;
  for (int i = 0; i < kPieces; ++i) u.push_back({-15.0 + 30.0 * i / kPieces, -0.004});
  u.insert(u.end(), {{15.0, -0.004}, {15.004, -0.004}, {15.004, 0.25}, {15.0, 0.25}});
  for (int i = 0; i < kPieces; ++i) u.push_back({15.0 - 30.0 * i / kPieces, 0.0});
  u.insert(u.end(), {{-15.0, 0.0}, {-15.0, 0.25}, {-15.004, 0.25}, {-15.004, -0.004}});
  check_triangulation({u});

  Loop outer;
  Loop inner;
  constexpr int kChords = 64;
  for (int i = 0; i < kChords; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kChords;
    outer.push_back(0.21 * Vec2{std::cos(angle), std::sin(angle)});
    inner.push_back(0.2 * Vec2{std::cos(angle), -std::sin(angle)});
  }
  check_triangulation({outer, inner});
}

TEST_CASE("end faces: an edge far from Delaunay is forced in") {
  // A thin tooth reaches between the corners of the base.
  check_triangulation(
      {{{0.0, 0.0}, {10.0, 0.0}, {10.0, 3.0}, {5.001, 3.0}, {5.0, 0.001}, {4.999, 3.0}, {0.0, 3.0}}});
  // A comb, its teeth one over another.
  Loop comb;
  for (int i = 0; i < 20; ++i) {
    comb.push_back({0.1 * i, 0.0});
    comb.push_back({0.1 * i + 0.05, 2.0});
  }
  comb.push_back({2.0, 0.0});
  comb.push_back({1.0, -0.01});
  std::reverse(comb.begin(), comb.end());
  if (area_of(comb) < 0.0) std::reverse(comb.begin(), comb.end());
  check_triangulation({comb});
}

TEST_CASE("end faces: outlines that cross or touch themselves are refused") {
  const std::string text = "the outline of an end face crosses or touches itself";
  CHECK(refusal({{{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}}) == text);  // crosses
  CHECK(refusal({{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}}) ==
        text);  // a corner on a side
  CHECK(refusal({{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}}) == text);  // a corner twice
  CHECK(refusal({{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}},
                 {{1.0, 1.0}, {1.0, 5.0}, {2.0, 5.0}, {2.0, 1.0}}}) == text);  // loops cross
}
