// Random tracks, sections and sizes: a solid that keeps every promise, or an error that says what to do.

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/constant_speed_curve.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/centerline/straight_line.hpp"
#include "glissade/core/error.hpp"
#include "glissade/io/mesh_file.hpp"
#include "glissade/solid/mesh_facts.hpp"
#include "glissade/solid/sweep.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"
#include "support/temp_dir.hpp"
#include "support/thorough.hpp"

#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace glissade;

namespace {

constexpr int kDesigns = 500;
constexpr int kQuick = 250;  // elsewhere than in CI

/// One size in [low, high), every order of magnitude as likely as the others.
double magnitude(testing::Random& random, double low, double high) {
  return low * std::pow(high / low, random.between(0.0, 1.0));
}

struct RandomDesign {
  CenterlinePtr centerline;
  CrossSection section = CrossSection::slab(1.0, 0.1);
  Placement placement;
  SweepOptions options;
  std::string words;
};

CenterlinePtr random_track(testing::Random& random, std::ostream& words) {
  const double run = magnitude(random, 0.01, 100.0);
  const double friction = random.between(0.0, 0.8);
  const double drop = run * (friction + magnitude(random, 1e-3, 10.0));
  const int kind = random.integer(0, 5);
  words << "run " << run << ", drop " << drop << ", mu " << friction;
  if (kind == 0) {
    words << ", straight; ";
    return std::make_shared<StraightLine>(Endpoints{run, drop});
  }
  if (kind == 1) {
    const Endpoints endpoints{run, run * random.between(0.05, 3.0)};
    const Friction mu = Friction::from_coefficient(friction + 0.05);
    const double p =
        ConstantSpeedCurve::smallest_p(endpoints, mu, kDefaultGravity) * magnitude(random, 1.0, 30.0) + 1e-9;
    words << ", constant-speed, drop " << endpoints.drop << ", P " << p << "; ";
    return std::make_shared<ConstantSpeedCurve>(endpoints, mu, kDefaultGravity, p);
  }
  if (kind == 2) {
    std::vector<ClothoidSegment> segments;
    const Angle entry = Angle::from_degrees(random.between(-20.0, 90.0));
    words << ", clothoids from " << entry.radians() << ":";
    double curvature = random.between(-2.0, 2.0) / run;
    for (int i = random.integer(1, 4); i > 0; --i) {
      const double next = random.between(-4.0, 4.0) / run;
      segments.push_back({run * random.between(0.1, 0.6), curvature, next});
      words << " " << segments.back().length << " " << curvature << " " << next << ",";
      curvature = random.integer(0, 1) == 0 ? next : 0.0;
    }
    words << " ";
    return std::make_shared<ClothoidSpline>(entry, segments);
  }
  words << ", fastest; ";
  return std::make_shared<CoulombBrachistochrone>(Endpoints{run, drop}, Friction::from_coefficient(friction));
}

/// A width for the whole track, or up to four along it.
WidthLaw random_widths(testing::Random& random, double width, double length, std::ostream& words) {
  if (random.integer(0, 2) > 0) return width;
  std::vector<WidthAt> knots;
  double at = length * random.between(-0.1, 0.5);
  for (int i = random.integer(2, 4); i > 0; --i) {
    const double factor = random.between(1.0, 1.6);
    knots.push_back({std::max(at, 0.0) + 1e-3 * length * static_cast<double>(knots.size()), factor * width});
    at = knots.back().at + std::max(0.7 * width, length * random.between(0.02, 0.4));
    words << ", width " << knots.back().width << " at " << knots.back().at;
  }
  return WidthLaw(std::move(knots));
}

CrossSection random_section(testing::Random& random, double length, std::ostream& words) {
  const double width = length * magnitude(random, 1e-3, 0.3);
  const double wall = width * magnitude(random, 0.1, 3.0);
  const double thickness = width * magnitude(random, 0.003, 0.5);
  words << "width " << width << ", wall " << wall << ", thickness " << thickness;
  switch (random.integer(0, 8)) {
    case 0:
      words << ", slab";
      return CrossSection(section::Slab{random_widths(random, width, length, words), thickness, 0.0, 0.0});
    case 1:
      words << ", slab with curbs";
      return CrossSection(
          section::Slab{random_widths(random, width, length, words), thickness, 0.3 * wall, 0.2 * width});
    case 2:
      words << ", u-channel";
      return CrossSection(section::UChannel{random_widths(random, width, length, words), wall, thickness});
    case 3: {
      const double lean = random.between(0.0, 60.0);
      words << ", trapezoid of " << lean << " deg";
      return CrossSection(section::Trapezoid{random_widths(random, width, length, words), wall,
                                             Angle::from_degrees(lean), thickness});
    }
    case 4: {
      const double above = random.integer(0, 1) == 0 ? 0.0 : wall;
      words << ", half-pipe with sides of " << above;
      return CrossSection::half_pipe(width, thickness, above);
    }
    case 6: {
      const double angle = random.between(25.0, 165.0);
      const double radius = wall * random.between(0.05, 0.9);
      words << ", v-channel of " << angle << " deg, radius " << radius;
      return CrossSection::v_channel(Angle::from_degrees(angle), radius, wall, thickness);
    }
    case 7: {
      const double groove = random.between(0.05, 0.4);
      words << ", track-groove, grooves of " << groove << " of the width";
      return CrossSection::track_groove(width, groove * width, 0.2 * wall,
                                        random.between(1.05, 1.3) * groove * width, thickness);
    }
    case 5:
      words << ", pipe";
      return CrossSection::pipe(width, thickness);
    default: {
      words << ", polygon";
      const double half = 0.5 * width;
      return CrossSection::polygon({{0.0, 0.0},
                                    {-half, 0.3 * wall},
                                    {-half - thickness, 0.2 * wall},
                                    {-0.3 * width, -thickness},
                                    {0.4 * width, -2.0 * thickness},
                                    {half, wall}});
    }
  }
}

RandomDesign random_design(testing::Random& random) {
  RandomDesign design;
  std::ostringstream words;
  words.precision(17);
  design.centerline = random_track(random, words);
  const double length = design.centerline->length();
  design.section = random_section(random, length, words);
  const double size = design.section.highest() - design.section.lowest();
  design.options.tolerance = std::min(size, length) * magnitude(random, 1e-3, 0.2);
  design.options.shape_triangles = 500;
  design.options.max_triangles = 10000;
  const Vec3 start{length * random.between(-3.0, 3.0), length * random.between(-3.0, 3.0),
                   length * random.between(-1.0, 3.0)};
  design.placement = Placement(start, Angle::from_degrees(random.between(-180.0, 180.0)));
  words << ", tolerance " << design.options.tolerance << ", start " << start.x << " " << start.y << " "
        << start.z << ", azimuth " << design.placement.azimuth().radians();
  design.words = words.str();
  return design;
}

void check_valid(const MeshFacts& facts, const Solid& solid) {
  for (const std::string& fault : facts.faults()) FAIL_CHECK(fault);
  CHECK(facts.components == 1);
  CHECK(facts.euler_characteristic == solid.expected_euler);
}

}  // namespace

TEST_CASE("sweep: random designs give a valid solid, in the file too, or an error that helps") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const TempDir dir;
  const int designs = testing::thorough() ? kDesigns : kQuick;
  int solids = 0;
  int trimmed = 0;
  int refused = 0;
  int too_fine_for_stl = 0;
  for (int i = 0; i < designs; ++i) {
    const RandomDesign design = random_design(random);
    INFO("design " << i << ": " << design.words);
    Solid solid;
    try {
      solid = sweep(*design.centerline, design.section, design.placement, design.options);
    } catch (const InputError& error) {
      ++refused;
      CHECK_THAT(error.what(), contains_text("Try: "));
      CHECK_THAT(error.what(), Catch::Matchers::StartsWith("cross_section: ") ||
                                   Catch::Matchers::StartsWith("tolerance: "));
      continue;
    }
    ++solids;
    trimmed += solid.trimmed ? 1 : 0;
    CHECK(solid.max_deviation <= design.options.tolerance);
    const MeshFacts exact = measure(solid.mesh);
    check_valid(exact, solid);
    CHECK(std::fabs(exact.volume - solid.exact_volume) <= exact.area * design.options.tolerance);
    const double turn =
        design.centerline->slope_angle(0.0) - design.centerline->slope_angle(design.centerline->length());
    const double untrimmed =
        design.section.area() * design.centerline->length() - design.section.first_moment() * turn;
    if (!solid.trimmed && !design.section.varies()) {
      CHECK(solid.exact_volume == Approx(untrimmed).epsilon(1e-12));
    }
    if (solid.trimmed) CHECK(solid.exact_volume > 0.0);

    try {
      write_mesh(dir / "solid.stl", MeshFormat::stl_binary, solid.mesh);
    } catch (const InputError& error) {
      ++too_fine_for_stl;
      CHECK_THAT(error.what(), contains_text("OFF or ASCII STL"));
      continue;
    }
    check_valid(measure(read_mesh(dir / "solid.stl")), solid);
  }
  // The designs are worth something only if they meet every kind of outcome.
  CAPTURE(solids, trimmed, refused, too_fine_for_stl);
  CHECK(solids > designs / 2);
  CHECK(trimmed > designs / 5);
  CHECK(refused > designs / 50);
}
