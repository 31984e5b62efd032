// measure() against exact rational geometry that shares nothing with it, and against CGAL's own mesh
// functions.

#include "glissade/solid/mesh_facts.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/shapes.hpp"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <boost/rational.hpp>

using namespace glissade;
using namespace glissade::shapes;

namespace {

using Fraction = boost::rational<long long>;
using Exact = std::array<Fraction, 3>;
using ExactTriangle = std::array<Exact, 3>;

Exact minus(const Exact& a, const Exact& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Fraction dot(const Exact& a, const Exact& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Exact cross(const Exact& a, const Exact& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact along(const Exact& from, const Exact& to, Fraction t) {
  const Exact way = minus(to, from);
  return {from[0] + t * way[0], from[1] + t * way[1], from[2] + t * way[2]};
}

using Interval = std::optional<std::pair<Fraction, Fraction>>;

/// Cuts off the part of an interval of t where value_0 + t (value_1 - value_0) < 0.
Interval clipped(const Interval& interval, Fraction value_0, Fraction value_1) {
  if (!interval || (value_0 < 0 && value_1 < 0)) return std::nullopt;
  auto [low, high] = *interval;
  if (value_0 >= 0 && value_1 >= 0) return interval;
  const Fraction zero = value_0 / (value_0 - value_1);
  if (value_0 < 0) low = std::max(low, zero);
  if (value_1 < 0) high = std::min(high, zero);
  return low <= high ? Interval({low, high}) : std::nullopt;
}

/// The part of a segment that lies in a triangle, as an interval of its parameter.
Interval part_within(const Exact& p, const Exact& q, const ExactTriangle& triangle) {
  const Exact normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
  Interval part = std::pair<Fraction, Fraction>{0, 1};
  const Fraction height_p = dot(normal, minus(p, triangle[0]));
  const Fraction height_q = dot(normal, minus(q, triangle[0]));
  part = clipped(part, height_p, height_q);
  part = clipped(part, -height_p, -height_q);
  for (std::size_t i = 0; i < 3; ++i) {
    const Exact inward = cross(normal, minus(triangle[(i + 1) % 3], triangle[i]));
    part = clipped(part, dot(inward, minus(p, triangle[i])), dot(inward, minus(q, triangle[i])));
  }
  return part;
}

bool is_between(const Exact& p, const Exact& a, const Exact& b) {
  const Exact to_p = minus(p, a);
  const Exact to_b = minus(b, a);
  return cross(to_p, to_b) == Exact{} && dot(to_p, to_b) >= 0 && dot(to_p, to_p) <= dot(to_b, to_b);
}

/// @return whether the part that two triangles have in common is more than their common vertex or edge
bool meet_exactly(const ExactTriangle& a, const ExactTriangle& b) {
  std::vector<Exact> common;
  for (const Exact& p : a) {
    if (std::find(b.begin(), b.end(), p) != b.end()) common.push_back(p);
  }
  if (common.size() == 3) return true;
  const auto is_common = [&common](const Exact& p) {
    if (common.size() == 2) return is_between(p, common[0], common[1]);
    return common.size() == 1 && p == common[0];
  };
  // What two triangles have in common is convex, and its corners lie on an edge of one of them.
  for (const auto& [edges, other] : {std::pair{a, b}, std::pair{b, a}}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval part = part_within(edges[i], edges[(i + 1) % 3], other);
      if (!part) continue;
      for (const Fraction& t : {part->first, part->second}) {
        if (!is_common(along(edges[i], edges[(i + 1) % 3], t))) return true;
      }
    }
  }
  return false;
}

bool has_area(const ExactTriangle& t) {
  return !(cross(minus(t[1], t[0]), minus(t[2], t[0])) == Exact{});
}

/// Corners on a small lattice: every kind of coincidence is common.
TriangleMesh lattice_soup(testing::Random& random, int facets, int size) {
  TriangleMesh mesh;
  for (int i = 0; i < 3 * facets; ++i) {
    mesh.vertices.push_back({static_cast<double>(random.integer(0, size)),
                             static_cast<double>(random.integer(0, size)),
                             static_cast<double>(random.integer(0, size))});
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(facets); ++i) {
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

struct ExactCounts {
  std::size_t degenerate = 0;
  std::size_t pairs = 0;
};

ExactCounts count_exactly(const TriangleMesh& mesh) {
  ExactCounts counts;
  std::vector<ExactTriangle> triangles;
  for (const auto& triangle : mesh.triangles) {
    ExactTriangle corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = mesh.vertices[triangle[i]];
      corners[i] = {static_cast<long long>(p.x), static_cast<long long>(p.y), static_cast<long long>(p.z)};
    }
    has_area(corners) ? triangles.push_back(corners) : void(++counts.degenerate);
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) counts.pairs += meet_exactly(triangles[i], triangles[j]) ? 1 : 0;
  }
  return counts;
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

SurfaceMesh surface_of(const TriangleMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  for (const Vec3& p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
  SurfaceMesh surface;
  pmp::polygon_soup_to_polygon_mesh(points, mesh.triangles, surface);
  return surface;
}

std::size_t cgal_self_intersections(const SurfaceMesh& surface) {
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
  pmp::self_intersections(surface, std::back_inserter(pairs));
  return pairs.size();
}

}  // namespace

TEST_CASE("soups on a lattice have the self-intersections that exact rational geometry finds") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  std::size_t pairs = 0;
  for (int round = 0; round < 600; ++round) {
    const TriangleMesh mesh = lattice_soup(random, 6, 2 + round % 3);
    const MeshFacts facts = measure(mesh);
    const ExactCounts expected = count_exactly(mesh);
    REQUIRE(facts.self_intersections == expected.pairs);
    REQUIRE(facts.degenerate_facets == expected.degenerate);
    pairs += expected.pairs;
  }
  CHECK(pairs > 500);
}

TEST_CASE("a solid with noise has the self-intersections, volume and area that CGAL finds") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const double noise : {0.0, 1e-6, 0.01, 0.03, 0.1, 0.3}) {
    TriangleMesh mesh = torus(1.0, 0.4, 60, 30);
    for (Vec3& p : mesh.vertices) {
      p = p +
          Vec3{random.between(-noise, noise), random.between(-noise, noise), random.between(-noise, noise)};
    }
    const SurfaceMesh surface = surface_of(mesh);
    const MeshFacts facts = measure(mesh);
    CHECK(facts.self_intersections == cgal_self_intersections(surface));
    CHECK(facts.closed() == CGAL::is_closed(surface));
    CHECK(facts.volume == Approx(pmp::volume(surface)).epsilon(1e-12));
    CHECK(facts.area == Approx(pmp::area(surface)).epsilon(1e-12));
  }
}

TEST_CASE("a flat, finely cut plate has no self-intersection, one with a fold the ones that CGAL finds") {
  // Everything in one plane, exactly or but for rounding: no sign is far from zero.
  constexpr std::uint32_t kSide = 40;
  for (const double slope : {0.0, 0.3}) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < kSide; ++i) {
      for (std::uint32_t j = 0; j < kSide; ++j) {
        mesh.vertices.push_back({0.1 * i + 1.0 / 3.0, 0.1 * j, slope * (0.3 * i + 0.07 * j)});
      }
    }
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
        const std::uint32_t a = i * kSide + j;
        mesh.triangles.push_back({a, a + kSide, a + kSide + 1});
        mesh.triangles.push_back({a, a + kSide + 1, a + 1});
      }
    }
    CHECK(measure(mesh).self_intersections == 0);
    CHECK(cgal_self_intersections(surface_of(mesh)) == 0);
    mesh.vertices[20 * kSide + 20] = mesh.vertices[18 * kSide + 17] + Vec3{0.01, 0.01, 0.0};
    const MeshFacts facts = measure(mesh);
    CHECK((facts.self_intersections > 0) == (slope == 0.0));
    CHECK(facts.self_intersections == cgal_self_intersections(surface_of(mesh)));
  }
}

TEST_CASE("solids within and beside each other bound a volume exactly when CGAL says so") {
  const auto nested = [](bool inner_is_flipped, bool outer_is_flipped) {
    const TriangleMesh outer = box({0, 0, 0}, {3, 3, 3});
    const TriangleMesh inner = box({1, 1, 1}, {2, 2, 2});
    return together(outer_is_flipped ? flipped(outer) : outer, inner_is_flipped ? flipped(inner) : inner);
  };
  for (const bool inner : {false, true}) {
    for (const bool outer : {false, true}) {
      const TriangleMesh mesh = nested(inner, outer);
      const SurfaceMesh surface = surface_of(mesh);
      const bool expected = pmp::does_bound_a_volume(surface) && !outer;
      CHECK(measure(mesh).oriented_outward == expected);
      CHECK(measure(mesh).valid() == expected);
    }
  }
}
