#include "glissade/solid/sweep.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/solid/mesh_facts.hpp"

#include "support/catch.hpp"
#include "support/cycloid_track.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace glissade;
using shapes::CycloidTrack;

namespace {

std::vector<CrossSection> one_of_each(double wall) {
  return {CrossSection::slab(0.4, 0.02),
          CrossSection::slab(0.4, 0.02, 0.05, 0.03),
          CrossSection::u_channel(0.4, wall, 0.004),
          CrossSection::trapezoid(0.3, wall, Angle::from_degrees(30.0), 0.005),
          CrossSection::half_pipe(2.0 * wall, 0.01),
          CrossSection::half_pipe(0.4, 0.01, 0.5 * wall),
          CrossSection::pipe(wall, 0.006),
          CrossSection::polygon({{0.0, 0.0}, {-0.2, 0.1}, {-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}})};
}

// Every promise of sweep() at once.
void check_solid(const Solid& solid, const SweepOptions& options) {
  const MeshFacts facts = measure(solid.mesh);
  for (const std::string& fault : facts.faults()) FAIL_CHECK(fault);
  CHECK(facts.valid());
  CHECK(facts.components == 1);
  CHECK(facts.euler_characteristic == solid.expected_euler);
  CHECK(facts.duplicate_vertices == 0);
  CHECK(facts.unused_vertices == 0);
  CHECK(solid.max_deviation <= options.tolerance);
  // Two faces, each off by no more than the tolerance.
  CHECK(std::fabs(facts.volume - solid.exact_volume) <= facts.area * options.tolerance);
}

double volume_of(const TriangleMesh& mesh) {
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_volumes += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
  }
  return six_volumes / 6.0;
}

std::string message_of(auto&& call) {
  try {
    static_cast<void>(call());
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("sweep: every cross-section follows a vertical start of unbounded curvature") {
  const CycloidTrack track(1.0, 4.0);
  SweepOptions options;
  options.tolerance = 2e-3;
  options.shape_triangles = 10000;
  for (const double wall : {0.05, 0.3, 1.0, 1.9}) {
    for (const CrossSection& section : one_of_each(wall)) {
      INFO(section.kind() << ", wall " << wall);
      const Solid solid =
          sweep(track, section, Placement({0.0, 0.0, 5.0}, Angle::from_degrees(20.0)), options);
      CHECK(solid.trimmed == (section.highest() > 0.0));
      check_solid(solid, options);
    }
  }
}

TEST_CASE("sweep: the start face lies in the plane of the start and is wider than the wall is high") {
  const double a = 1.0;
  const CycloidTrack track(a, 3.0);
  const double wall = 0.5;
  const Solid solid = sweep(track, CrossSection::u_channel(0.4, wall, 0.004), Placement());
  double highest = -1.0;
  double widest = 0.0;
  for (const Vec3 v : solid.mesh.vertices) {
    highest = std::max(highest, v.z);
    if (v.z > -1e-12) widest = std::max(widest, v.x);
  }
  CHECK(highest == Approx(0.0).margin(1e-12));
  // The normal that meets the level of the start at height n = 2 a sin(t/2) does so at run a t.
  CHECK(widest == Approx(2.0 * a * std::asin(0.5 * wall / a)).epsilon(1e-10));
}

TEST_CASE("sweep: a straight track gives the section times its length exactly") {
  const StraightLine track(Endpoints{3.0, 2.0});
  for (const CrossSection& section : one_of_each(0.3)) {
    INFO(section.kind());
    SweepOptions options;
    options.tolerance = 1e-3;
    const Solid solid =
        sweep(track, section, Placement({1.0, 2.0, 3.0}, Angle::from_degrees(-130.0)), options);
    check_solid(solid, options);
    CHECK_FALSE(solid.trimmed);
    CHECK(solid.exact_volume == Approx(section.area() * track.length()).epsilon(1e-14));
    if (section.chord_error(1.0) == 0.0) {
      CHECK(measure(solid.mesh).volume == Approx(solid.exact_volume).epsilon(1e-12));
    }
  }
}

TEST_CASE("sweep: an untrimmed volume is V = A S - M dphi, met at order 2") {
  // A valley of radius 2 m turned by 60 deg, and a crest.
  const double angle = std::numbers::pi / 3.0;
  for (const double curvature : {0.5, -0.5}) {
    const ClothoidSpline track(Angle::from_degrees(curvature > 0.0 ? 60.0 : 0.0),
                               {{2.0 * angle, curvature, curvature}});
    const CrossSection section = CrossSection::u_channel(0.4, 0.3, 0.01);
    const double exact =
        section.area() * 2.0 * angle - section.first_moment() * std::copysign(angle, curvature);
    double last_error = 0.0;
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
      SweepOptions options;
      options.tolerance = tolerance;
      options.shape_triangles = 2000;
      const Solid solid = sweep(track, section, Placement(), options);
      CHECK_FALSE(solid.trimmed);
      CHECK(solid.exact_volume == Approx(exact).epsilon(1e-14));
      const double error = std::fabs(volume_of(solid.mesh) / exact - 1.0);
      const double step = track.length() / static_cast<double>(solid.stations.size() - 1);
      // An arc's chords lose dphi^2/6 of the area below them.
      CHECK(error == Approx(step * step * 0.25 / 6.0).epsilon(0.1));
      if (last_error > 0.0) CHECK(error < last_error);
      last_error = error;
    }
    CHECK(last_error < 1e-6);
  }
}

TEST_CASE("sweep: a wall higher than the start has room for is refused with the height that works") {
  const CycloidTrack track(1.0, 4.0);
  SweepOptions options;
  options.tolerance = 5e-3;
  const auto build = [&](double wall) {
    return sweep(track, CrossSection::u_channel(0.4, wall, 0.01), Placement(), options);
  };
  const std::string message = message_of([&] { return build(2.1); });
  // Above twice the cycloid's a, no normal meets the start face any more.
  CHECK_THAT(message, Catch::Matchers::StartsWith("cross_section: it reaches 2.1 m above the floor"));
  CHECK_THAT(message, contains_text("its radius is 0 there"));
  const std::string lead = "Try: a section that reaches at most ";
  const auto at = message.find(lead);
  REQUIRE(at != std::string::npos);
  const double named = std::stod(message.substr(at + lead.size()));
  CHECK(named > 1.97);
  CHECK(named <= 2.0);
  check_solid(build(named), options);
}

TEST_CASE("sweep: a mesh that would not fit is refused at once, with its size and a tolerance that fits") {
  const ClothoidSpline track(Angle::from_degrees(60.0), {{1e5, 1e-5, 1e-5}});
  SweepOptions options;
  options.tolerance = 1e-7;
  options.max_triangles = 2000000;
  const CrossSection section = CrossSection::u_channel(0.4, 0.3, 0.01);
  const std::string message = message_of([&] { return sweep(track, section, Placement(), options); });
  CHECK_THAT(message, Catch::Matchers::StartsWith("tolerance: 0.0001 mm needs ") &&
                          contains_text(" triangles, ") && contains_text("B of memory") &&
                          contains_text("at most 2 million triangles"));

  options.tolerance = 1e-6;
  options.max_triangles = 2000;
  const CycloidTrack small(1.0, 3.0);
  const std::string refusal = message_of([&] { return sweep(small, section, Placement(), options); });
  const std::string lead = "Try: a tolerance of ";
  const auto at = refusal.find(lead);
  INFO(refusal);
  REQUIRE(at != std::string::npos);
  options.tolerance = 1e-3 * std::stod(refusal.substr(at + lead.size()));
  const Solid solid = sweep(small, section, Placement(), options);
  CHECK(solid.mesh.triangles.size() <= options.max_triangles);
  CHECK(solid.mesh.triangles.size() > options.max_triangles / 4);
}

TEST_CASE("sweep: options outside their bounds are refused") {
  const StraightLine track(Endpoints{3.0, 2.0});
  const CrossSection section = CrossSection::slab(0.4, 0.02);
  const auto build = [&](double tolerance, std::size_t limit) {
    SweepOptions options;
    options.tolerance = tolerance;
    options.max_triangles = limit;
    return sweep(track, section, Placement({1e6, 0.0, 0.0}, Angle()), options);
  };
  for (const double tolerance :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK_THAT(message_of([&] { return build(tolerance, 1000000); }), contains_text("is not a distance"));
  }
  CHECK_THAT(message_of([&] { return build(1e-3, 999); }), contains_text("max_triangles: 999 is too few"));
  CHECK_THAT(message_of([&] { return build(1e-12, 1000000); }),
             contains_text("is finer than the coordinates can carry"));
}

TEST_CASE("sweep: far from the origin the solid is still valid") {
  SweepOptions options;
  options.tolerance = 1e-3;
  const Solid solid = sweep(CycloidTrack(1.0, 3.5), CrossSection::half_pipe(0.5, 0.005),
                            Placement({1e6, -2e6, 500.0}, Angle::from_degrees(77.0)), options);
  check_solid(solid, options);
}

TEST_CASE("sweep: same input, same mesh") {
  const CycloidTrack track(0.5, 3.5);
  const CrossSection section = CrossSection::pipe(0.2, 0.01);
  const Solid first = sweep(track, section, Placement());
  const Solid second = sweep(track, section, Placement());
  CHECK(first.mesh.vertices == second.mesh.vertices);
  CHECK(first.mesh.triangles == second.mesh.triangles);
}
