// How often a proof asks for exact arithmetic, which is where its time goes.

#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/solid/sweep.hpp"

#include "solid/self_intersections.hpp"
#include "support/catch.hpp"

using namespace glissade;

TEST_CASE("of a solid of flat walls no more pairs are left to exact arithmetic where it is turned") {
  // Corners of a turned wall lie in its plane to the last digits only: facets of it at a common corner, which no plane
  // between their middles parts, take exact arithmetic, and the proof four times as long as along the axis. Along it
  // CGAL's filters settle them.
  const CoulombBrachistochrone track(Endpoints{3.0, 2.0}, Friction::from_coefficient(0.2));
  for (const double degrees : {0.0, 30.0, 45.0, 100.0}) {
    const TriangleMesh mesh = sweep(track, CrossSection::u_channel(0.4, 0.3, 0.004),
                                    Placement({}, Angle::from_degrees(degrees)), {.tolerance = 1e-8})
                                  .mesh;
    const solid::SelfIntersections found = solid::find_self_intersections(
        mesh.vertices, mesh.triangles, solid::SelfIntersectionLimits::for_facets(mesh.triangles.size()));
    CHECK(found.pairs == 0);
    // 0.086; where only planes between the middles of facets of one plane are tried, 0.094.
    INFO(degrees << " deg");
    CHECK(static_cast<double>(found.exact) < 0.09 * static_cast<double>(mesh.triangles.size()));
  }
}
