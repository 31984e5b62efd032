#include "parts/bodies/body_mesh.hpp"

#include "glissade/core/math.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "parts/bodies/body_moments.hpp"
#include "support/catch.hpp"
#include "support/shop_parts.hpp"

#include <cmath>

using namespace glissade;

namespace {

/// @return a body's mesh, found to be a solid's
TriangleMesh sound_mesh(const PartBody& body, double tolerance, int round_corners = 3) {
  TriangleMesh mesh = parts::facets_of(body, tolerance, round_corners);
  const MeshFacts facts = measure(mesh);
  CHECK(facts.boundary_edges == 0);
  CHECK(facts.non_manifold_edges == 0);
  CHECK(facts.self_intersections == 0);
  CHECK(facts.oriented_outward);
  CHECK(facts.components == 1);
  return mesh;
}

}  // namespace

TEST_CASE("Bodies of every kind become closed facets whose volume tends to theirs", "[body_mesh]") {
  for (const ShopPart& part : testing::sample_workshop().parts) {
    CAPTURE(part.name);
    const double exact = parts::moments(part.body).volume;
    double before = 1.0;
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
      CAPTURE(tolerance);
      const double volume = measure(sound_mesh(part.body, tolerance)).volume;
      const double missed = std::fabs(volume / exact - 1.0);
      CHECK((missed < 0.5 * before || missed < 1e-12));
      before = missed;
    }
    CHECK(before < 1e-3);
  }
}

TEST_CASE("Chords stay within the tolerance of their arcs", "[body_mesh]") {
  // A disc with a hole, its chords' middles held against its circles.
  const Prism ring{{path_of(Circle{{0.3, -0.2}, 0.5}), {}, {{{0.3, -0.2}, 0.2}}}, 0.01};
  for (const double tolerance : {2e-2, 1e-3, 1e-5}) {
    const TriangleMesh mesh = sound_mesh(ring, tolerance);
    double worst = 0.0;
    for (const Vec3& vertex : mesh.vertices) {
      const double radius = norm(Vec2{vertex.x - 0.3, vertex.y + 0.2});
      CHECK(std::min(std::fabs(radius - 0.5), std::fabs(radius - 0.2)) < 1e-12);
    }
    for (const auto& [a, b, c] : mesh.triangles) {
      for (const auto& [i, j] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        const Vec3 middle = 0.5 * (mesh.vertices[i] + mesh.vertices[j]);
        const double radius = norm(Vec2{middle.x - 0.3, middle.y + 0.2});
        if (mesh.vertices[i].z == mesh.vertices[j].z && radius > 0.45) worst = std::max(worst, 0.5 - radius);
      }
    }
    CHECK(worst <= tolerance * (1.0 + 1e-9));
    CHECK(worst > 0.2 * tolerance);
  }
}

TEST_CASE("A full turn has as many chords as asked for", "[body_mesh]") {
  const Prism disc{{path_of(Circle{{}, 0.01}), {}, {}}, 0.01};
  CHECK(sound_mesh(disc, 1.0, 12).vertices.size() == 24);
  const TubeGore tube{0.1, 0.002, 0.5, {}, Angle::from_radians(0.3)};
  CHECK(sound_mesh(tube, 1.0, 12).vertices.size() == 48);
}

TEST_CASE("Arcs close beside each other are drawn finer where their chords would cross", "[body_mesh]") {
  // A ring of 1 mm whose corners lie at other angles outside than inside.
  const ArcPath inside = moved(path_of(Circle{{}, 0.999}), PlaneMotion::turn(0.3));
  const Prism ring{{path_of(Circle{{}, 1.0}), {inside}, {}}, 0.01};
  const TriangleMesh mesh = sound_mesh(ring, 0.1);
  CHECK(mesh.vertices.size() > 40);
}

TEST_CASE("A mesh on a grid stays within a cell of what it was", "[body_mesh]") {
  const Prism ring{{path_of(Circle{{}, 0.5}), {}, {{{}, 0.2}}}, 0.05};
  const TriangleMesh fine = parts::facets_of(ring, 1e-7);
  const TriangleMesh coarse = parts::coarsened(fine, 0.01);
  CHECK(coarse.triangles.size() < fine.triangles.size() / 4);
  CHECK(coarse.vertices.size() < fine.vertices.size() / 4);
  for (const auto& triangle : coarse.triangles) {
    for (const std::uint32_t corner : triangle) CHECK(corner < coarse.vertices.size());
  }
  CHECK(measure(coarse).volume == Approx(parts::moments(ring).volume).epsilon(0.05));
}

TEST_CASE("Sheets with slots and tabs, troughs and sections that move across become closed facets",
          "[body_mesh]") {
  // Both arcs have one tangent where they meet.
  const double heading = math::atan2(-0.4, 1.0) + 2.0 * (math::atan(0.15) - math::atan(0.1));
  const Vec2 end{1.0 + 0.8 * math::cos(heading), -0.4 + 0.8 * math::sin(heading)};
  const ArcPath path{{{{0.0, 0.0}, 0.15}, {{1.0, -0.4}, -0.1}, {end, 0.0}}, false};
  const double whole = length(path);
  RolledSheet sheet{path,
                    0.02,
                    {{{{{0.0, 0.1}, 0.0},
                       {{0.2, 0.1}, 0.0},
                       {{0.2, 0.0}, 0.0},
                       {{0.4, 0.0}, 0.0},
                       {{0.4, 0.1}, 0.0},
                       {{whole, 0.1}, 0.0},
                       {{whole, 0.5}, 0.0},
                       {{0.0, 0.5}, 0.0}},
                      true},
                     {rectangle({0.5, 0.2}, {0.6, 0.3}), rectangle({1.4, 0.3}, {1.5, 0.4})},
                     {}}};
  const TroughGore trough{0.2, 0.01, 0.1, 0.6, Angle::from_radians(0.1), Angle::from_radians(-0.2)};
  const TroughGore shallow{0.2, 0.01, 0.0, 0.6, Angle::from_radians(0.1), Angle()};
  const SweptBody wide{{{{{0.0, 0.0}, 0.1}, {{1.0, -0.4}, 0.0}}, false},
                       {{-0.01, 0.0}, {0.0, 0.0}, {0.0, 0.3}, {-0.01, 0.3}},
                       {{0.0, 0.0, 0.0, 0.0}, {-0.1, -0.1, 0.1, 0.1}}};
  for (const PartBody& body : {PartBody(sheet), PartBody(trough), PartBody(shallow), PartBody(wide)}) {
    CAPTURE(body.index());
    const double exact = parts::moments(body).volume;
    CHECK(measure(sound_mesh(body, 1e-5)).volume == Approx(exact).epsilon(1e-3));
    CHECK(measure(sound_mesh(body, 1e-7)).volume == Approx(exact).epsilon(1e-5));
  }
}
