#include "glissade/solid/mesh_facts.hpp"

#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/shapes.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace mesh_facts_test {

using namespace glissade;
using namespace glissade::shapes;

namespace {

std::string message_of(const TriangleMesh& mesh) {
  try {
    (void)measure(mesh);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::vector<std::string>& faults, const std::string& text) {
  for (const std::string& fault : faults) {
    if (fault.find(text) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a tetrahedron is valid and has the facts known by hand") {
  const MeshFacts facts = measure(tetrahedron());
  CHECK(facts.valid());
  CHECK(facts.faults().empty());
  CHECK(facts.vertices == 4);
  CHECK(facts.triangles == 4);
  CHECK(facts.components == 1);
  CHECK(facts.euler_characteristic == 2);
  CHECK(facts.volume == Approx(1.0 / 6.0).epsilon(1e-15));
  CHECK(facts.area == Approx(1.5 + std::sqrt(3.0) / 2.0).epsilon(1e-15));
  CHECK(facts.smallest_angle.radians() == Approx(std::numbers::pi / 4.0).epsilon(1e-15));
  CHECK(facts.shortest_edge == 1.0);
  CHECK(facts.lower == Vec3{0, 0, 0});
  CHECK(facts.upper == Vec3{1, 1, 1});
}

TEST_CASE("a box has its volume and area wherever it stands") {
  for (const double offset : {0.0, 1.0, -37.5, 1e4}) {
    const MeshFacts facts = measure(moved(box({0, 0, 0}, {2, 0.5, 0.25}), {offset, 2 * offset, -offset}));
    CHECK(facts.valid());
    CHECK(facts.volume == Approx(0.25).epsilon(1e-15));
    CHECK(facts.area == Approx(2.0 * (1.0 + 0.5 + 0.125)).epsilon(1e-15));
    CHECK(facts.smallest_angle.radians() == Approx(std::atan(0.125)).epsilon(1e-15));
  }
}

TEST_CASE("a torus has Euler characteristic 0 and nears its volume and area at second order") {
  const double volume = 2.0 * std::numbers::pi * std::numbers::pi * 3.0;
  const double area = 4.0 * std::numbers::pi * std::numbers::pi * 3.0;
  const MeshFacts coarse = measure(torus(3, 1, 60, 30));
  const MeshFacts fine = measure(torus(3, 1, 120, 60));
  for (const MeshFacts& facts : {coarse, fine}) {
    CHECK(facts.valid());
    CHECK(facts.euler_characteristic == 0);
    CHECK(facts.components == 1);
  }
  CHECK((volume - coarse.volume) / (volume - fine.volume) == Approx(4.0).epsilon(0.01));
  CHECK((area - coarse.area) / (area - fine.area) == Approx(4.0).epsilon(0.01));
}

TEST_CASE("a solid turned inside out is watertight but not outward") {
  const MeshFacts facts = measure(flipped(unit_cube()));
  CHECK(facts.watertight());
  CHECK_FALSE(facts.oriented_outward);
  CHECK_FALSE(facts.valid());
  CHECK(facts.volume == Approx(-1.0));
  CHECK(facts.faults() ==
        std::vector<std::string>{"1 piece whose facets face the wrong way: inside out, and no cavity within "
                                 "another; at (0 mm, 0 mm, 0 mm)"});
}

TEST_CASE("pieces that face the wrong way are counted and placed, each kind of them") {
  const TriangleMesh block = box({0, 0, 0}, {9, 9, 9});
  const TriangleMesh cavity = flipped(box({1, 1, 1}, {4, 4, 4}));
  const MeshFacts mixed = measure(together(
      together(together(block, cavity), together(box({5, 5, 5}, {6, 6, 6}), box({7, 7, 7}, {8, 8, 8}))),
      flipped(box({500, 0, 0}, {501, 1, 1}))));
  CHECK_FALSE(mixed.oriented_outward);
  CHECK(mixed.inside_out_pieces == 1);
  CHECK(mixed.nested_pieces == 2);
  CHECK(mixed.faults() == std::vector<std::string>{"1 piece whose facets face the wrong way: inside out, and "
                                                   "no cavity within another; at (500 m, 0 mm, 0 mm)",
                                                   "2 pieces within others whose facets face the wrong way: "
                                                   "a cavity's would face inwards; the first at "
                                                   "(5 m, 5 m, 5 m)"});
  // Where pieces intersect nothing is known of what lies within what: only what is inside out is told.
  const MeshFacts crossed =
      measure(together(together(block, box({8, 8, 8}, {10, 10, 10})), flipped(box({20, 0, 0}, {21, 1, 1}))));
  CHECK(crossed.self_intersections > 0);
  CHECK(crossed.inside_out_pieces == 1);
  CHECK(crossed.nested_pieces == 0);
  // A sound piece within one that is inside out is not to blame.
  const MeshFacts within = measure(together(flipped(block), box({5, 5, 5}, {6, 6, 6})));
  CHECK_FALSE(within.oriented_outward);
  CHECK(within.inside_out_pieces == 1);
  CHECK(within.nested_pieces == 0);
  // An open one has no inside.
  TriangleMesh open = flipped(unit_cube());
  open.triangles.pop_back();
  CHECK(measure(open).inside_out_pieces == 0);
}

TEST_CASE("a cavity faces its material, a solid within a cavity is one again") {
  const TriangleMesh shell = together(box({0, 0, 0}, {9, 9, 9}), flipped(box({1, 1, 1}, {8, 8, 8})));
  const MeshFacts hollow = measure(shell);
  CHECK(hollow.valid());
  CHECK(hollow.components == 2);
  CHECK(hollow.euler_characteristic == 4);
  CHECK(hollow.volume == Approx(729.0 - 343.0));
  const MeshFacts with_core = measure(together(shell, box({3, 3, 3}, {4, 4, 4})));
  CHECK(with_core.valid());
  CHECK(with_core.volume == Approx(729.0 - 343.0 + 1.0));
  CHECK_FALSE(measure(together(shell, flipped(box({3, 3, 3}, {4, 4, 4})))).oriented_outward);
  CHECK_FALSE(measure(together(shell, flipped(box({20, 0, 0}, {21, 1, 1})))).oriented_outward);
  CHECK_FALSE(measure(together(box({0, 0, 0}, {9, 9, 9}), box({1, 1, 1}, {8, 8, 8}))).oriented_outward);
}

TEST_CASE("one flipped facet makes three edges non-manifold") {
  TriangleMesh mesh = unit_cube();
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  const MeshFacts facts = measure(mesh);
  CHECK(facts.closed());
  CHECK(facts.non_manifold_edges == 3);
  CHECK(facts.non_manifold_vertices == 0);
  CHECK_FALSE(facts.valid());
}

TEST_CASE("a missing facet leaves three boundary edges") {
  TriangleMesh mesh = unit_cube();
  mesh.triangles.pop_back();
  const MeshFacts facts = measure(mesh);
  CHECK(facts.boundary_edges == 3);
  CHECK(facts.manifold());
  CHECK_FALSE(facts.closed());
  CHECK(facts.euler_characteristic == 1);
  CHECK(contains(facts.faults(), "3 edges with one facet only"));
}

TEST_CASE("cubes that share an edge are not manifold there") {
  const MeshFacts facts = measure(welded(together(unit_cube(), box({1, 1, 0}, {2, 2, 1}))));
  CHECK(facts.vertices == 14);
  CHECK(facts.non_manifold_edges == 1);
  CHECK(facts.non_manifold_vertices == 2);
  CHECK(facts.closed());
  CHECK(facts.self_intersections == 0);
  CHECK(facts.volume == Approx(2.0));
}

TEST_CASE("cubes that share a vertex are two pieces and not manifold there") {
  const MeshFacts facts = measure(welded(together(unit_cube(), box({1, 1, 1}, {2, 2, 2}))));
  CHECK(facts.vertices == 15);
  CHECK(facts.components == 2);
  CHECK(facts.non_manifold_edges == 0);
  CHECK(facts.non_manifold_vertices == 1);
  CHECK(facts.self_intersections == 0);
}

TEST_CASE("cubes that touch in a vertex of equal position but other number have a duplicate vertex") {
  const MeshFacts facts = measure(together(unit_cube(), box({1, 1, 1}, {2, 2, 2})));
  CHECK(facts.watertight());
  CHECK(facts.duplicate_vertices == 1);
  CHECK(facts.self_intersections == 0);
  CHECK_FALSE(facts.valid());
}

TEST_CASE("a bow-tie of two triangles on one vertex is open and not manifold there") {
  const MeshFacts facts =
      measure({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}});
  CHECK(facts.boundary_edges == 6);
  CHECK(facts.non_manifold_vertices == 1);
  CHECK(facts.components == 2);
  CHECK(facts.self_intersections == 0);
}

TEST_CASE("a Moebius band has Euler characteristic 0, a boundary, and one seam of opposite winding") {
  const MeshFacts facts = measure(moebius(24));
  CHECK(facts.euler_characteristic == 0);
  CHECK(facts.boundary_edges == 48);
  CHECK(facts.non_manifold_edges == 1);
  CHECK(facts.non_manifold_vertices == 0);
  CHECK(facts.self_intersections == 0);
}

TEST_CASE("interpenetrating cubes intersect, cubes apart do not") {
  // Faces that cross at right angles: every facet pair counted by hand below.
  const MeshFacts crossing = measure(together(unit_cube(), box({0.5, 0.25, 0.25}, {1.5, 0.75, 0.75})));
  CHECK(crossing.watertight());
  CHECK(crossing.self_intersections > 0);
  CHECK(crossing.self_intersections_complete);
  CHECK_FALSE(crossing.valid());
  CHECK(measure(together(unit_cube(), box({1.5, 0, 0}, {2, 1, 1}))).valid());
}

TEST_CASE("cubes that touch in part of a face intersect") {
  CHECK(measure(together(unit_cube(), box({1, 0.25, 0.25}, {2, 0.75, 0.75}))).self_intersections > 0);
}

TEST_CASE("two crossing triangles are one pair, however they cross") {
  const TriangleMesh base{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}};
  const auto pairs = [&base](Vec3 a, Vec3 b, Vec3 c) {
    return measure(together(base, {{a, b, c}, {{0, 1, 2}}})).self_intersections;
  };
  CHECK(pairs({1, 1, -1}, {1, 1, 1}, {2, 1, 1}) == 1);                // through
  CHECK(pairs({1, 1, 0}, {1, 1, 1}, {2, 1, 1}) == 1);                 // a corner on the face
  CHECK(pairs({0.5, 0.5, 0}, {1, 0.5, 0}, {0.5, 1, 0}) == 1);         // in its plane, inside
  CHECK(pairs({2, 0, 0}, {3, -1, 0}, {2, -1, 0}) == 1);               // in its plane, a corner on the edge
  CHECK(pairs({0, 0, 1}, {4, 0, 1}, {0, 4, 1}) == 0);                 // parallel
  CHECK(pairs({0, 0, 1e-300}, {4, 0, 1e-300}, {0, 4, 1e-300}) == 0);  // parallel, as close as doubles go
  CHECK(pairs({3, 3, -1}, {3, 3, 1}, {4, 4, 0}) == 0);                // crosses the plane beside it
  CHECK(pairs({0, 0, 0}, {-1, -1, 1}, {-1, -1, -1}) == 0);            // one common vertex
  CHECK(pairs({0, 0, 0}, {1, 1, 1}, {1, 1, -1}) == 1);                // one common vertex, and through
  CHECK(pairs({0, 0, 0}, {1, 0, 0}, {0, -1, 0}) == 1);                // one common vertex, along an edge
  CHECK(pairs({0, 0, 0}, {4, 0, 0}, {0, 0, 4}) == 0);                 // a common edge, upright
  CHECK(pairs({0, 0, 0}, {4, 0, 0}, {1, 1, 0}) == 1);                 // a common edge, folded flat
  CHECK(pairs({0, 0, 0}, {4, 0, 0}, {1, 1, 1e-300}) == 0);            // a common edge, all but folded flat
  CHECK(pairs({0, 0, 0}, {4, 0, 0}, {0, -4, 0}) == 0);                // a common edge, side by side
  CHECK(pairs({0, 0, 0}, {0, 4, 0}, {4, 0, 0}) == 1);                 // the same facet, other way round
}

TEST_CASE("facets without area and repeated vertices are counted and do no harm") {
  TriangleMesh mesh = unit_cube();
  mesh.triangles.push_back({0, 0, 1});
  mesh.vertices.push_back({0.5, 0, 0});
  mesh.triangles.push_back({0, 8, 1});
  const MeshFacts facts = measure(mesh);
  CHECK(facts.degenerate_facets == 2);
  CHECK(facts.smallest_angle.radians() == 0.0);
  CHECK_FALSE(facts.valid());
  CHECK(contains(facts.faults(), "2 facets without area"));
}

TEST_CASE("an angle too small for doubles to see is not a facet without area") {
  const MeshFacts facts = measure({{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-170, 0}}, {{0, 1, 2}}});
  CHECK(facts.degenerate_facets == 0);
}

TEST_CASE("an empty mesh is not a solid") {
  const MeshFacts facts = measure({});
  CHECK_FALSE(facts.valid());
  CHECK_FALSE(facts.closed());
  CHECK(contains(facts.faults(), "no facets"));
}

TEST_CASE("an unused vertex is counted and is no fault") {
  TriangleMesh mesh = unit_cube();
  mesh.vertices.push_back({5, 5, 5});
  const MeshFacts facts = measure(mesh);
  CHECK(facts.unused_vertices == 1);
  CHECK(facts.upper.x == measure(unit_cube()).upper.x);  // no part of the solid
  CHECK(facts.volume == measure(unit_cube()).volume);
  CHECK(facts.euler_characteristic == 2);
  CHECK(facts.valid());
}

TEST_CASE("-0 and 0 are one position") {
  CHECK(measure({{{0, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}}, {}}).duplicate_vertices == 1);
}

TEST_CASE("a hostile heap of facets ends at the limit and says so") {
  TriangleMesh mesh;
  for (int i = 0; i < 800; ++i) {
    const double a = 0.001 * i;
    mesh = together(std::move(mesh), {{{a, -1, -1}, {a + 1, 1, -1}, {1 - a, 0.1 * a, 1}}, {{0, 1, 2}}});
  }
  const MeshFacts facts = measure(mesh);
  CHECK(facts.self_intersections == 100'000);
  CHECK_FALSE(facts.self_intersections_complete);
  CHECK(contains(facts.faults(), "at least 100000 pairs"));
}

TEST_CASE("every fault says where the first of its kind lies") {
  // A unit square of two facets, 5 m up.
  const TriangleMesh open{{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}}, {{0, 1, 2}, {0, 2, 3}}};
  CHECK(contains(measure(open).faults(), "surface is open; the first at (500 mm, 0 mm, 5 m)"));
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {4, 0, 0}, {5, 0, 0}, {6, 0, 0}},
                          {{0, 1, 2}, {3, 4, 5}}};
  CHECK(contains(measure(flat).faults(), "1 facet without area; at (4 m, 0 mm, 0 mm)"));
  const TriangleMesh twice{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 8, 9}, {7, 8, 9}}, {{0, 1, 2}}};
  CHECK(contains(measure(twice).faults(), "1 vertex at the position of another; at (7 m, 8 m, 9 m)"));
  const TriangleMesh crossed{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {0.7, 0.7, 1}},
                             {{0, 1, 2}, {3, 4, 5}}};
  CHECK(contains(measure(crossed).faults(),
                 "1 pair of facets that intersect; at (616.667 mm, 616.667 mm, 166.667 mm)"));
  const TriangleMesh fins{{{0, 0, 0}, {0, 0, 2}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                          {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}};
  CHECK(contains(measure(fins).faults(), "two of opposite winding; at (0 mm, 0 mm, 1 m)"));
  const TriangleMesh tips{{{3, 0, 0}, {4, 0, 0}, {4, 1, 0}, {2, 0, 0}, {2, 1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  CHECK(contains(measure(tips).faults(), "1 vertex whose facets are not one fan; at (3 m, 0 mm, 0 mm)"));
}

TEST_CASE("a mesh that cannot be measured is refused with the place") {
  CHECK(message_of({{{0, 0, 0}}, {{0, 0, 7}}}).find("triangle 0 of the mesh: vertex 7 does not exist") == 0);
  CHECK(message_of({{{0, std::numeric_limits<double>::quiet_NaN(), 0}}, {}}).find("vertex 0") !=
        std::string::npos);
  CHECK(message_of({{{1e61, 0, 0}}, {}}).find("1e+60") != std::string::npos);
  const TriangleMesh speck{{{0, 0, 0}, {1e-299, 0, 0}, {0, 1e-299, 0}}, {{0, 1, 2}}};
  CHECK(message_of(speck).find("the mesh is 1e-299 m long, too small to be measured") == 0);
}

TEST_CASE("a cube is valid at every size that is not refused, with the angles of a cube") {
  for (int power = -80; power <= 58; ++power) {
    CAPTURE(power);
    const double side = std::pow(10.0, power);
    TriangleMesh cube = box({0.0, 0.0, 0.0}, {side, side, side});
    if (side < kSmallestMeshSize) {
      CHECK_THROWS_AS(measure(cube), InputError);
      continue;
    }
    const MeshFacts facts = measure(cube);
    CHECK(facts.valid());
    CHECK(facts.smallest_angle.degrees() == Approx(45.0).epsilon(1e-12));
    CHECK(facts.volume == Approx(side * side * side).epsilon(1e-12));
  }
}

}  // namespace mesh_facts_test
