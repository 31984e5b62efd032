// The height of a chord against arcs, where it is known exactly.

#include "solid/chord_sagitta.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/core/units.hpp"
#include "glissade/solid/sweep.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>

using namespace glissade;

namespace {

constexpr double kAccuracy = 1e-4;  // accuracy: ChordSagitta

/// A straight, an arc that rises and 1 m straight on.
ClothoidSpline arc_behind(double straight, double radius, double turn, double scale = 1.0) {
  const double curvature = 1.0 / (scale * radius);
  return {Angle::from_degrees(35.0),
          {{scale * straight, 0.0, 0.0}, {scale * radius * turn, curvature, curvature}, {scale, 0.0, 0.0}}};
}

/// The greatest height of a chord of the mesh over the arc that its lowest level is.
double sagitta_of_arc(const TriangleMesh& mesh, const Vec2& centre, double radius) {
  double worst = 0.0;
  const auto from_centre = [&](const Vec3& at) { return std::hypot(at.x - centre.x, at.z - centre.y); };
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = mesh.vertices[triangle[i]];
      const Vec3 b = mesh.vertices[triangle[(i + 1) % 3]];
      const auto on_arc = [&](const Vec3& at) {
        return std::fabs(from_centre(at) - radius) < 1e-10 * radius;
      };
      if (!on_arc(a) || !on_arc(b)) continue;
      worst = std::max(worst, radius - from_centre(0.5 * (a + b)));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("chord of an arc: its height is exact, however far along the track and however short it is") {
  for (const double straight : {0.5, 3.0, 60.0, 3000.0}) {
    for (const double radius : {0.3, 4.3}) {
      for (const double step : {0.5, 0.13, 0.011, 0.0004}) {  // [rad]
        CAPTURE(straight, radius, step);
        const ClothoidSpline track = arc_behind(straight, radius, 0.6);
        const double from = straight + 0.01 * radius;
        const double to = from + step * radius;
        const solid::ChordSagitta sagitta(track, from, to);
        for (const double height : {-0.02, 0.0, 0.2}) {
          const auto level = [&](double s) { return solid::offset(solid::station_at(track, s), height); };
          const double half = std::sin(0.25 * step);
          const double exact = 2.0 * (radius - height) * half * half;
          // Points of a track so long are known to 1e-14 of it.
          const double told = sagitta.of_level(height, level(from), level(to), 0.0);
          CHECK(std::fabs(told - exact) <= kAccuracy * exact + 1e-14 * straight);
        }
      }
    }
  }
}

TEST_CASE("deviation of a sweep: that of its facets from the arc, far along a track and small ones too") {
  struct Case {
    double straight, radius, tolerance, scale;
  };
  for (const Case& at : {Case{60.0, 4.3, 5e-4, 1.0}, Case{3.0, 2.0, 5e-6, 1.0}, Case{30.0, 3.0, 1.3e-5, 1.0},
                         Case{60.0, 4.3, 5e-4, 1.0 / 333.0}}) {
    CAPTURE(at.straight, at.radius, at.tolerance, at.scale);
    const ClothoidSpline track = arc_behind(at.straight, at.radius, 0.5, at.scale);
    const CrossSection section = CrossSection::u_channel(0.4 * at.scale, 0.25 * at.scale, 0.02 * at.scale);
    SweepOptions options;
    options.tolerance = at.tolerance * at.scale;
    const Solid solid = sweep(track, section, {}, options);
    const CenterlinePoint foot = track.at(at.scale * at.straight);
    const Angle slope = Angle::from_degrees(35.0);
    // The track leans down by its slope angle; an arc that rises has its centre above it.
    const double radius = at.scale * at.radius;
    const Vec2 centre =
        Vec2{foot.x, -foot.drop} + radius * Vec2{std::sin(slope.radians()), std::cos(slope.radians())};
    const double exact = sagitta_of_arc(solid.mesh, centre, radius + 0.02 * at.scale);
    CHECK(exact > 0.0);
    CHECK(solid.max_deviation == Approx(exact).epsilon(1e-3));
    CHECK(exact <= options.tolerance);
  }
}
