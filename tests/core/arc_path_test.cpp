#include "glissade/core/arc_path.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

using glissade::ArcPath;
using glissade::Circle;
using glissade::PathPiece;
using glissade::PlaneMotion;
using glissade::PlaneRegion;
using glissade::Vec2;

constexpr double kPi = 3.14159265358979323846;
/// Relative area that the steps of flattened(), never shorter than 1e-3 rad, leave between chords and arcs; and what they leave of
/// arcs so flat that they take one or two of them.
constexpr double kChordsCost = 2e-5;
constexpr double kFlatArcsCost = 2e-4;

/// A closed path without crossings: corners round a centre, sides that bow in or out a little.
ArcPath random_blob(testing::Random& random, Vec2 centre, double size) {
  ArcPath path{{}, true};
  const int corners = random.integer(3, 9);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * kPi * (i + random.between(0.0, 0.5)) / corners;
    const double radius = size * random.between(0.8, 1.0);
    const double bulge = random.integer(0, 2) == 0 ? 0.0 : random.between(-0.08, 0.3);
    path.vertices.push_back({centre + radius * Vec2{std::cos(angle), std::sin(angle)}, bulge});
  }
  return path;
}

/// A second route: the polygon of very many points on the path.
double polygon_area(const std::vector<Vec2>& points) {
  double twice = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) twice += glissade::cross(points[i], points[i + 1]);
  return 0.5 * twice;
}

double least_sampled_distance(const ArcPath& a, const ArcPath& b) {
  constexpr int kSteps = 120;
  double least = std::numeric_limits<double>::infinity();
  for (const PathPiece& piece : glissade::pieces_of(a)) {
    for (const PathPiece& other : glissade::pieces_of(b)) {
      for (int i = 0; i <= kSteps; ++i) {
        for (int k = 0; k <= kSteps; ++k) {
          const Vec2 apart =
              glissade::point_on(piece, double(i) / kSteps) - glissade::point_on(other, double(k) / kSteps);
          least = std::min(least, glissade::dot(apart, apart));
        }
      }
    }
  }
  return std::sqrt(least);
}

}  // namespace

TEST_CASE("a rectangle with a hole has the area, centre and bounds that everybody can work out") {
  PlaneRegion region{glissade::rectangle({1.0, 2.0}, {5.0, 4.0}), {}, {{{2.0, 3.0}, 0.5}}};
  const auto moments = glissade::moments(region);
  const double hole = kPi * 0.25;
  CHECK(moments.area == Approx(8.0 - hole).epsilon(1e-15));
  CHECK(moments.centroid.x == Approx((8.0 * 3.0 - hole * 2.0) / (8.0 - hole)).epsilon(1e-14));
  CHECK(moments.centroid.y == Approx(3.0).epsilon(1e-14));
  CHECK(glissade::bounds(region.outline).width() == 4.0);
  CHECK(glissade::length(region.outline) == 12.0);
  CHECK(glissade::faults_of(region).empty());
}

TEST_CASE("a circle as a path has its circle's length, area, centre and bounds") {
  const Circle circle{{3.0, -2.0}, 1.5};
  const ArcPath path = glissade::path_of(circle);
  CHECK(glissade::length(path) == Approx(3.0 * kPi).epsilon(1e-15));
  CHECK(glissade::signed_area(path) == Approx(2.25 * kPi).epsilon(1e-15));
  CHECK(glissade::bounds(path).low == Vec2{1.5, -3.5});
  CHECK(glissade::bounds(path).high == Vec2{4.5, -0.5});
  const auto moments = glissade::moments({path, {}, {}});
  CHECK(moments.centroid.x == Approx(3.0));
  CHECK(moments.centroid.y == Approx(-2.0));
}

TEST_CASE("area and centre of a half disc and of a flat cap are those of the books") {
  // y of a half disc's centre: 4 r/(3 pi). A flat cap tends to a parabola's: 2/3 chord sagitta, 2/5 sagitta.
  const auto half = glissade::moments({{{{{1.0, 0.0}, 1.0}, {{-1.0, 0.0}, 0.0}}, true}, {}, {}});
  CHECK(half.area == Approx(kPi / 2).epsilon(1e-15));
  CHECK(half.centroid.y == Approx(4.0 / (3.0 * kPi)).epsilon(1e-14));
  const double bulge = 1e-6;  // sagitta bulge * chord / 2
  const auto flat = glissade::moments({{{{{1.0, 0.0}, bulge}, {{-1.0, 0.0}, 0.0}}, true}, {}, {}});
  CHECK(flat.area == Approx(2.0 / 3.0 * 2.0 * bulge).epsilon(1e-10));
  CHECK(flat.centroid.y == Approx(0.4 * bulge).epsilon(1e-9));
}

TEST_CASE("outlines along bends whose radii hardly differ have no fault, and one that meets itself has") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < 200; ++round) {
    // A strip: both long sides are chains of tangent arcs, each with a little more or less curvature than the one before.
    const double curvature = std::pow(10.0, random.between(-4.0, -0.5));
    const double change = std::pow(10.0, random.between(-12.0, -0.5));
    ArcPath path{{}, true};
    std::vector<glissade::PathVertex> back;
    Vec2 at{random.between(-5.0, 5.0), random.between(-5.0, 5.0)};
    double heading = random.between(-3.0, 3.0);
    constexpr double kWide = 0.2;
    const auto aside = [&] { return at + kWide * Vec2{-std::sin(heading), std::cos(heading)}; };
    for (int piece = random.integer(2, 5); piece > 0; --piece) {
      const double length = random.between(0.01, 0.8);
      const double sweep = length * curvature * (1.0 + random.between(-change, change));
      // Tangent but for what rounding leaves.
      const auto rounded = [&](Vec2 place) {
        return place + Vec2{random.between(-1e-12, 1e-12), random.between(-1e-12, 1e-12)};
      };
      path.vertices.push_back({rounded(at), std::tan(0.25 * sweep)});
      back.push_back({rounded(aside()), 0.0});
      const double chord = length * std::sin(0.5 * sweep) / (0.5 * sweep);
      at = at + chord * Vec2{std::cos(heading + 0.5 * sweep), std::sin(heading + 0.5 * sweep)};
      heading += sweep;
      back.back().bulge = -std::tan(0.25 * sweep);
    }
    path.vertices.push_back({at, 0.0});
    // From the end back to the start: each bulge belongs to the vertex that its piece begins with.
    path.vertices.push_back({aside(), back.back().bulge});
    for (std::size_t i = back.size(); i-- > 0;)
      path.vertices.push_back({back[i].at, i > 0 ? back[i - 1].bulge : 0.0});
    CAPTURE(round, curvature, change);
    CHECK(glissade::faults_of({path, {}, {}}) == std::vector<std::string>{});
  }
  // Walls of a nearly straight channel, as a build laid them out.
  const std::vector<glissade::PathVertex> walls[] = {
      {{{8.6278901467657239e-05, 0}, -1.8434734489680496e-06},
       {{0.010394343490118089, 4.6163433515727387e-06}, -0.00010885495839617564},
       {{0.62270485316282409, 0.0001426730526083455}, -0.0001146041411497189},
       {{1.2647285689517984, 1.0842021724855044e-19}, 0},
       {{1.2648148427138082, 0.19108334089582549}, 0.0001146041411497189},
       {{0.62270352945452434, 0.1912260334146906}, 0.00010885495839617564},
       {{0.010309473616914663, 0.19108795786840849}, 1.8434734489680496e-06},
       {{0, 0.19108334089404047}, 0}},
      {{{0, 0.00014247544345380447}, 1.0578665384140135e-05},
       {{0.059258648956386224, 0.00011698490725724385}, 4.8578593600431316e-05},
       {{0.33188545057122054, 3.2158089683199031e-05}, 0.00016632950530466809},
       {{1.2638025020639572, 0.00014247544172679661}, 0},
       {{1.263716316630547, 0.1912258163607842}, -0.00016632950530466809},
       {{0.33192639633660198, 0.19111551405812421}, -4.8578593600431316e-05},
       {{0.059336789291455347, 0.19120032930274597}, -1.0578665384140135e-05},
       {{8.6226118591727893e-05, 0.19122581636078428}, 0}}};
  for (const std::vector<glissade::PathVertex>& wall : walls)
    CHECK(glissade::faults_of({{wall, true}, {}, {}}) == std::vector<std::string>{});
  // Most of a circle, and a straight piece that leads on through it.
  const double bulge = std::tan(0.25 * 5.5);
  const ArcPath loop{{{{0.0, 0.0}, bulge}, {{0.5, 0.0}, 0.0}, {{-0.4, -1.0}, 0.0}}, true};
  CHECK(glissade::faults_of({loop, {}, {}}) == std::vector<std::string>{"the outline meets itself"});
}

TEST_CASE(
    "random outlines: area, bounds and length agree with their finest polygon, whichever way round and "
    "moved") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int round = 0; round < 60; ++round) {
    const ArcPath path = random_blob(random, {random.between(-3.0, 3.0), random.between(-3.0, 3.0)}, 1.0);
    const std::vector<Vec2> points = glissade::flattened(path, 1e-9);
    const double area = glissade::signed_area(path);
    CHECK(area == Approx(polygon_area(points)).epsilon(kChordsCost).margin(kFlatArcsCost));
    CHECK(glissade::signed_area(glissade::reversed(path)) == Approx(-area).epsilon(1e-13));
    CHECK(glissade::reversed(glissade::reversed(path)) == path);
    const auto box = glissade::bounds(path);
    const auto lowest =
        *std::min_element(points.begin(), points.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
    CHECK(box.low.y == Approx(lowest.y).margin(1e-6));
    PlaneMotion motion = PlaneMotion::turn(random.between(-3.0, 3.0), {random.between(-9.0, 9.0), 1.0});
    motion.mirrored = round % 2 == 0;
    const ArcPath elsewhere = glissade::moved(path, motion);
    CHECK(glissade::signed_area(elsewhere) == Approx(motion.mirrored ? -area : area).epsilon(1e-12));
    CHECK(glissade::length(elsewhere) == Approx(glissade::length(path)).epsilon(1e-13));
    const Vec2 centre = glissade::moments({path, {}, {}}).centroid;
    const Vec2 there = glissade::moments({elsewhere, {}, {}}).centroid;
    CHECK(glissade::norm(motion(centre) - there) < 1e-12);
    CHECK(glissade::faults_of({path, {}, {}}) == std::vector<std::string>{});
  }
}

TEST_CASE("random points: inside the path is inside its finest polygon") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int inside = 0;
  for (int round = 0; round < 40; ++round) {
    const ArcPath path = random_blob(random, {0.0, 0.0}, 1.0);
    ArcPath polygon{{}, true};
    for (const Vec2 point : glissade::flattened(path, 1e-7)) polygon.vertices.push_back({point});
    polygon.vertices.pop_back();
    for (int i = 0; i < 25; ++i) {
      const Vec2 point{random.between(-1.2, 1.2), random.between(-1.2, 1.2)};
      const bool is_inside = glissade::contains(path, point);
      inside += is_inside ? 1 : 0;
      if (glissade::distance(path, {{{point}, {point + Vec2{1e-9, 0.0}}}, false}) < 1e-5) continue;
      CHECK(is_inside == glissade::contains(polygon, point));
    }
  }
  CHECK(inside > 200);
}

TEST_CASE("random pieces: their distance is that of many points on them, and 0 where they cross") {
  testing::Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int apart = 0;
  for (int round = 0; round < 200; ++round) {
    const auto any = [&] {
      const Vec2 from{random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
      const Vec2 to{random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
      return ArcPath{{{from, random.integer(0, 1) == 0 ? 0.0 : random.between(-1.8, 1.8)}, {to}}, false};
    };
    const ArcPath a = any();
    const ArcPath b = any();
    const double found = glissade::distance(a, b);
    CHECK(found == Approx(glissade::distance(b, a)).margin(1e-12));
    CHECK(found == Approx(least_sampled_distance(a, b)).margin(0.03));
    apart += found > 0.0 ? 1 : 0;
  }
  CHECK(apart > 50);
  CHECK(apart < 190);
}

TEST_CASE("what cannot be cut is said: open, doubled, crossing, outside, overlapping") {
  PlaneRegion region{glissade::rectangle({0.0, 0.0}, {1.0, 1.0}), {}, {}};
  const auto faults = [&] { return glissade::faults_of(region); };
  region.holes = {{{0.5, 0.5}, 0.1}, {{0.65, 0.5}, 0.1}};
  CHECK(faults() == std::vector<std::string>{"hole 2 touches hole 1"});
  region.holes = {{{0.95, 0.5}, 0.1}, {{3.0, 3.0}, 0.1}};
  CHECK(faults() ==
        std::vector<std::string>{"hole 1 reaches outside the outline", "hole 2 reaches outside the outline"});
  region.holes = {};
  region.cutouts = {glissade::rectangle({0.2, 0.2}, {0.4, 0.4}),
                    glissade::rectangle({0.25, 0.25}, {0.3, 0.3})};
  CHECK(faults() == std::vector<std::string>{"cutout 2 touches cutout 1"});
  region.cutouts = {};
  region.outline.vertices.insert(region.outline.vertices.begin() + 1, {{1.0, 0.0}});
  CHECK(faults() ==
        std::vector<std::string>{"the outline, piece 2, has no length", "the outline meets itself"});
  region.outline = {{{{0.0, 0.0}}, {{1.0, 1.0}}, {{1.0, 0.0}}, {{0.0, 1.0}}}, true};  // a bow tie
  CHECK(faults().front() == "the outline meets itself");
  region.outline = glissade::rectangle({0.0, 0.0}, {1.0, 1.0});
  region.outline.closed = false;
  CHECK(faults() == std::vector<std::string>{"the outline is open"});
  region.outline.vertices[0].at.x = std::numeric_limits<double>::quiet_NaN();
  CHECK(faults() == std::vector<std::string>{"a coordinate is not a finite number"});
}
