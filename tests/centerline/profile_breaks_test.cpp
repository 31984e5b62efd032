// Profiles whose curvature jumps: what builders drew must come back as they drew it.
#include "glissade/centerline/fitted_profile.hpp"
#include "glissade/motion/motion.hpp"

#include "support/catch.hpp"
#include "support/known_profiles.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

using namespace glissade;
using testing::KnownProfile;
using testing::Random;

namespace {

double highest_load(const Centerline& curve) {
  const CenterlinePtr shared(&curve, [](const Centerline*) {});
  return Motion(shared, {Friction::from_coefficient(0.03), 0.0, 0.0}).highest_load().normal_load;
}

std::vector<KnownProfile> profiles() {
  return {
      testing::known_in_run(33.0, 9.5, 70.0, 5.6, 60.0),
      testing::known_in_run(35.0, 11.0, 103.0, 6.9, 60.0),
      testing::known_profile("straight and arc", 35.0, {{60.0, 0.0, 0.0}, {40.0, 0.01, 0.01}}),
      testing::known_profile("straight, arc, table", 35.0,
                             {{60.0, 0.0, 0.0}, {30.0, 1.0 / 70.0, 1.0 / 70.0}, {8.0, 0.0, 0.0}}),
      testing::known_profile("straight, clothoid, table", 35.0,
                             {{60.0, 0.0, 0.0}, {40.0, 0.0, 1.0 / 60.0}, {8.0, 0.0, 0.0}}),
      testing::known_profile(
          "clothoid, arc, clothoid", 40.0,
          {{30.0, 0.0, 0.0}, {10.0, 0.0, 0.025}, {15.0, 0.025, 0.025}, {10.0, 0.025, 0.0}, {10.0, 0.0, 0.0}}),
  };
}

/// Straights one after the other, each flatter than the one before.
struct Polygon {
  std::vector<double> slopes;  // [rad]
  std::vector<double> lengths;

  [[nodiscard]] double length() const { return std::accumulate(lengths.begin(), lengths.end(), 0.0); }
  [[nodiscard]] std::vector<Vec2> points(int count) const {
    std::vector<Vec2> all;
    for (int i = 0; i < count; ++i) {
      double left = length() * i / (count - 1);
      Vec2 place;
      for (std::size_t k = 0; k < slopes.size() && left > 0.0; left -= lengths[k++]) {
        const double along = std::min(left, lengths[k]);
        place = place + Vec2{along * std::cos(slopes[k]), along * std::sin(slopes[k])};
      }
      all.push_back(place);
    }
    return all;
  }
};

/// With 1 to 3 kinks of 2 to 40 degrees.
Polygon random_polygon(Random& random) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  Polygon drawn;
  do {
    drawn = {{random.between(35.0, 70.0) * kDegree}, {random.between(1.0, 4.0)}};
    for (int i = random.integer(1, 3); i > 0; --i) {
      drawn.slopes.push_back(drawn.slopes.back() -
                             std::exp(random.between(std::log(2.0), std::log(40.0))) * kDegree);
      drawn.lengths.push_back(random.between(1.0, 4.0));
    }
  } while (drawn.slopes.back() < 8.0 * kDegree);
  return drawn;
}

std::vector<Vec2> rounded(std::vector<Vec2> points, double place) {
  if (place == 0.0) return points;
  for (Vec2& point : points)
    point = {place * std::nearbyint(point.x / place), place * std::nearbyint(point.y / place)};
  return points;
}

}  // namespace

TEST_CASE("exact points of profiles with jumps of curvature give radius and load back, however many") {
  Random random(1);
  int number = 0;
  for (const int count : {50, 103, 263, 600}) {
    for (const KnownProfile& known : profiles()) {
      // Elsewhere than in CI each with 103 points, every other one with few, every third one with many.
      const bool is_quick =
          count == 103 || (count == 50 && number % 2 == 0) || (count == 263 && number % 3 == 0);
      ++number;
      if (!is_quick && !testing::thorough()) continue;
      INFO(known.name << ", radius " << known.smallest_radius << " m, " << count << " points");
      const FittedProfile profile(points_of(known, count, 0.0, random));
      CHECK(testing::smallest_valley_radius(profile.curve()) == Approx(known.smallest_radius).epsilon(0.02));
      CHECK(highest_load(profile) == Approx(highest_load(*known.truth)).epsilon(0.01));
      CHECK(profile.max_deviation() < 1e-6 * known.length);
      CHECK_FALSE(profile.leaves_pattern());
    }
  }
}

TEST_CASE("straights, arcs and clothoids come back to rounding from exact points") {
  Random random(1);
  for (const KnownProfile& known : profiles()) {
    if (known.name == "in-run") continue;
    const FittedProfile profile(points_of(known, 120, 0.0, random));
    const std::vector<ClothoidSegment>& found = profile.curve().segments();
    const std::vector<ClothoidSegment>& drawn = known.truth->segments();
    INFO(known.name);
    REQUIRE(found.size() == drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      CHECK(found[i].length == Approx(drawn[i].length).epsilon(1e-9));
      CHECK(found[i].entry_curvature == Approx(drawn[i].entry_curvature).margin(1e-10));
      CHECK(found[i].exit_curvature == Approx(drawn[i].exit_curvature).margin(1e-10));
    }
  }
}

TEST_CASE("a millimetre of noise costs little of radius and load where points are many") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  int number = 0;
  for (const KnownProfile& known : profiles()) {
    if (number++ % 2 == 1 && !testing::thorough()) continue;
    INFO(known.name << ", radius " << known.smallest_radius << " m");
    const FittedProfile profile(points_of(known, 700, 1e-3, random));
    CHECK(testing::smallest_valley_radius(profile.curve()) == Approx(known.smallest_radius).epsilon(0.06));
    CHECK(highest_load(profile) == Approx(highest_load(*known.truth)).epsilon(0.04));
    CHECK(profile.rms_deviation() == Approx(1e-3).epsilon(0.15));
  }
}

TEST_CASE("random tracks of arcs and straights come back from exact points") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int trial = 0; trial < (testing::thorough() ? 8 : 5); ++trial) {
    std::vector<ClothoidSegment> segments = {{random.between(10.0, 30.0), 0.0, 0.0}};
    const int bends = random.integer(1, 3);
    for (int i = 0; i < bends; ++i) {
      const double curvature = (i % 2 == 0 ? 1.0 : -1.0) / random.between(25.0, 80.0);
      segments.push_back({random.between(8.0, 16.0), curvature, curvature});
      if (random.integer(0, 1) == 0) segments.push_back({random.between(6.0, 12.0), 0.0, 0.0});
    }
    const KnownProfile known = testing::known_profile("random", random.between(20.0, 40.0), segments);
    const int count = random.integer(60, 300);
    INFO("trial " << trial << ", " << segments.size() << " segments, " << count << " points");
    const FittedProfile profile(points_of(known, count, 0.0, random));
    CHECK(testing::smallest_valley_radius(profile.curve()) == Approx(known.smallest_radius).epsilon(1e-6));
    CHECK(profile.max_deviation() < 1e-9 * known.length);
  }
}

TEST_CASE("straights that meet in valleys have kinks there and no crest, however many points show them") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int trials = testing::thorough() ? 60 : 8;
  for (int trial = 0; trial < trials; ++trial) {
    const Polygon drawn = random_polygon(random);
    const int count = static_cast<int>(std::exp(random.between(std::log(40.0), std::log(2000.0))));
    // As computed, as programs write it, and as people round it.
    constexpr double kMicron = 1e-6;
    constexpr double kTenth = 1e-4;
    const double place = std::vector<double>{0.0, 0.0, kMicron, kTenth}[static_cast<std::size_t>(trial) % 4];
    INFO("trial " << trial << ", " << count << " points, rounded to " << place << " m, "
                  << drawn.slopes.size() << " straights");
    const auto profile = std::make_shared<const FittedProfile>(rounded(drawn.points(count), place));
    const double allowed = 1e-9 + 300.0 * place / drawn.length();
    double steepest = -1.0;
    double flattest = 2.0;
    double before = 2.0;
    double rise = 0.0;  // of the slope angle along the track: a crest
    for (const double s : profile->breaks()) {
      const double slope = profile->slope_angle(s);
      steepest = std::max(steepest, slope);
      flattest = std::min(flattest, slope);
      rise = std::max(rise, slope - before);
      before = slope;
    }
    CHECK(steepest <= drawn.slopes.front() + allowed);
    CHECK(flattest >= drawn.slopes.back() - allowed);
    CHECK(rise <= allowed);
    CHECK(Motion(profile, {Friction::from_coefficient(0.05), 0.0, 1.0}).arrived());
    if (place > 0.0) continue;
    CHECK(profile->curve().segments().size() == 2 * drawn.slopes.size() - 1);
    CHECK(profile->max_deviation() < 1e-7 * drawn.length());
    // Between the points beside a kink the bend may be any: that is told.
    CHECK(profile->largest_curvature().has_value());
  }
}

TEST_CASE("a point in the kink itself makes it one: as sharp as curves can be, and met") {
  for (const int count : {21, 41, 201, 1001}) {
    const Polygon drawn{{0.7, 0.3}, {5.0, 5.0}};
    INFO(count << " points");
    const auto profile = std::make_shared<const FittedProfile>(drawn.points(count));
    CHECK(profile->max_deviation() < 1e-7 * drawn.length());
    CHECK(testing::smallest_valley_radius(profile->curve()) < 1e-6 * drawn.length());
    CHECK(Motion(profile, {Friction::from_coefficient(0.1), 0.0, 0.0}).arrived());
  }
}

TEST_CASE(
    "points of a cycloid crowd at its vertical start: noise makes them neither coil nor begin elsewhere") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr double kRadius = 2.0;
  constexpr double kPhase = 2.6;
  const double speed = std::sqrt(2.0 * kDefaultGravity * kRadius * (1.0 - std::cos(kPhase)));
  const int trials = testing::thorough() ? 40 : 3;
  for (int trial = 0; trial < trials; ++trial) {
    const int count = std::vector<int>{2000, 3000, 500}[static_cast<std::size_t>(trial) % 3];
    const double noise = std::vector<double>{3e-3, 1e-3}[static_cast<std::size_t>(trial) % 2];
    INFO("trial " << trial << ", " << count << " points, noise " << noise << " m");
    std::vector<Vec2> points;
    for (int i = 0; i < count; ++i) {
      const double phase = kPhase * i / (count - 1);
      points.push_back({kRadius * (phase - std::sin(phase)) + noise * testing::bell(random),
                        kRadius * (1.0 - std::cos(phase)) + noise * testing::bell(random)});
    }
    const auto profile = std::make_shared<const FittedProfile>(points);
    double most = std::fabs(profile->slope_angle(0.0));
    for (const double s : profile->breaks()) most = std::max(most, std::fabs(profile->slope_angle(s)));
    CHECK(most <= std::numbers::pi / 2.0);
    CHECK(profile->slope_angle(0.0) > 1.35);
    CHECK(profile->rms_deviation() == Approx(noise).epsilon(0.3));
    const Motion motion(profile, {Friction(), 0.0, 0.0});
    REQUIRE(motion.arrived());
    CHECK(motion.exit_speed() == Approx(speed).epsilon(2e-3));
    CHECK(motion.travel_time() == Approx(kPhase * std::sqrt(kRadius / kDefaultGravity)).epsilon(0.02));
  }
}

TEST_CASE("the same points in another place, turned round or in another unit give the same pieces") {
  Random random(4);
  const KnownProfile known = profiles()[3];
  std::vector<Vec2> points = points_of(known, 150, 1e-3, random);
  const FittedProfile here(points);
  for (Vec2& point : points) point = {-1e-3 * point.x + 7.0, 1e-3 * point.y - 3.0};
  const FittedProfile there(points);
  REQUIRE(there.curve().segments().size() == here.curve().segments().size());
  for (std::size_t i = 0; i < here.curve().segments().size(); ++i) {
    CHECK(1e3 * there.curve().segments()[i].length ==
          Approx(here.curve().segments()[i].length).epsilon(1e-4));
  }
  CHECK(1e3 * there.max_deviation() == Approx(here.max_deviation()).epsilon(1e-3));
}

TEST_CASE("a curve that passes over what its points show is told by their pattern") {
  // Ripples of 5 mm and 60 cm length on a hill of points 1 m apart: no curve can follow, and neighbours do not
  // go together. Ripples of 6 m are followed.
  std::vector<Vec2> followed;
  for (int i = 0; i < 80; ++i) {
    followed.push_back({1.0 * i, 0.4 * i + 0.005 * std::sin(2.0 * 3.14159265358979 * i / 6.0)});
  }
  CHECK_FALSE(FittedProfile(followed).leaves_pattern());
  // Waves shorter than the stretches whose means stand for so many points.
  std::vector<Vec2> waves;
  for (int i = 0; i < (testing::thorough() ? 12'000 : 4'000); ++i) {
    const double x = 0.1 * i;
    waves.push_back({x, 0.4 * x + 0.02 * std::sin(2.0 * 3.14159265358979 * x / 0.8)});
  }
  const FittedProfile passed_over(waves);
  CHECK(passed_over.rms_deviation() > 5e-3);
  CHECK(passed_over.leaves_pattern());
}

TEST_CASE("a millimetre of noise at a hundred points hides neither radius nor load") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (const KnownProfile& known : profiles()) {
    const int draws = !testing::thorough() ? 1 : known.name == "in-run" ? 40 : 3;
    for (int draw = 0; draw < draws; ++draw) {
      INFO(known.name << ", radius " << known.smallest_radius << " m, draw " << draw);
      const FittedProfile profile(points_of(known, 100, 1e-3, random));
      CHECK(testing::smallest_valley_radius(profile.curve()) == Approx(known.smallest_radius).epsilon(0.02));
      CHECK(highest_load(profile) == Approx(highest_load(*known.truth)).epsilon(0.01));
    }
  }
}

namespace {

/// The points as a file of so many decimals has them.
std::vector<Vec2> rounded(std::vector<Vec2> points, int decimals) {
  const double places = std::pow(10.0, decimals);
  for (Vec2& point : points)
    point = {std::round(point.x * places) / places, std::round(point.y * places) / places};
  return points;
}

/// A random track of straights, arcs and clothoids as they are drawn, a few hundred points of which would show all.
KnownProfile drawn_profile(Random& random) {
  const double size = std::exp(random.between(std::log(10.0), std::log(100.0)));
  const double radius = size * random.between(0.3, 1.2);
  const double bend = radius * random.between(0.14, 0.44);
  const double curvature = 1.0 / radius;
  const ClothoidSegment before{size * random.between(0.2, 0.6), 0.0, 0.0};
  const ClothoidSegment behind{size * random.between(0.2, 0.5), 0.0, 0.0};
  std::vector<ClothoidSegment> segments;
  switch (random.integer(0, 4)) {
    case 0:
      segments = {before, {bend, curvature, curvature}, behind};
      break;
    case 1:
      segments = {before, {bend, curvature, curvature}};
      break;
    case 2:
      segments = {before, {1.3 * bend, 0.0, curvature}, behind};
      break;
    case 3:
      segments = {before,
                  {0.5 * bend, 0.0, curvature},
                  {0.5 * bend, curvature, curvature},
                  {0.4 * bend, curvature, 0.0},
                  behind};
      break;
    default:
      segments = {before,
                  {bend, curvature, curvature},
                  behind,
                  {0.5 * bend, -0.8 * curvature, -0.8 * curvature},
                  behind};
  }
  return testing::known_profile("drawn", random.between(20.0, 50.0), segments);
}

double largest_curvature_of(const ClothoidSpline& curve) {
  double most = 0.0;
  for (const ClothoidSegment& segment : curve.segments())
    most = std::max({most, std::fabs(segment.entry_curvature), std::fabs(segment.exit_curvature)});
  return most;
}

}  // namespace

TEST_CASE("points rounded to decimals give radius and load back: what rounding leaves is no shape") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int draws = testing::thorough() ? 40 : 4;
  constexpr int kCounts[] = {103, 263, 700, 2000};
  for (int draw = 0; draw < draws; ++draw) {
    const KnownProfile known = drawn_profile(random);
    const int count = kCounts[random.integer(0, testing::thorough() ? 3 : 2)];
    const int decimals = random.integer(4, 6);
    INFO("draw " << draw << ", " << count << " points of " << decimals << " decimals on " << known.length
                 << " m, " << known.truth->segments().size() << " segments");
    const FittedProfile profile(rounded(points_of(known, count, 0.0, random), decimals));
    const double truth = largest_curvature_of(*known.truth);
    CHECK(largest_curvature_of(profile.curve()) == Approx(truth).epsilon(0.02));
    CHECK(highest_load(profile) == Approx(highest_load(*known.truth)).epsilon(0.01));
    CHECK(profile.rms_deviation() < 0.4 * std::pow(10.0, -decimals));
    CHECK_FALSE(profile.leaves_pattern());
  }
}

TEST_CASE("round numbers that are exact are no rounding") {
  // Whole metres of x, and of z what a parabola of two decimals has there.
  std::vector<Vec2> points;
  for (int i = 0; i <= 60; ++i) points.push_back({static_cast<double>(i), 1.2 * i - 0.01 * i * i});
  const FittedProfile profile(points);
  CHECK(profile.max_deviation() < 5e-6);
  CHECK(largest_curvature_of(profile.curve()) == Approx(0.02).epsilon(1e-3));
}

TEST_CASE("what noise leaves open of the smallest radius is told: the true one is hardly ever outside") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int draws = testing::thorough() ? 110 : 16;
  int off = 0;
  int untold = 0;
  int outside = 0;
  int narrow = 0;
  for (int draw = 0; draw < draws; ++draw) {
    const KnownProfile known = drawn_profile(random);
    const int count = random.integer(50, 400);
    const FittedProfile profile(points_of(known, count, 1e-3, random));
    const double truth = largest_curvature_of(*known.truth);
    const double found = largest_curvature_of(profile.curve());
    const auto& range = profile.largest_curvature();
    if (!range) continue;
    CHECK(range->least <= found * (1.0 + 1e-6));
    CHECK(range->greatest >= found * (1.0 - 1e-6));
    const bool inside = range->least <= 1.01 * truth && range->greatest >= 0.99 * truth;
    outside += inside ? 0 : 1;
    narrow += profile.leaves_radius_open() ? 0 : 1;
    if (std::fabs(found / truth - 1.0) <= 0.1) continue;
    ++off;
    untold += profile.leaves_radius_open() ? 0 : 1;
  }
  INFO(off << " of " << draws << " off by more than 10 %, " << untold << " of them untold, " << outside
           << " outside, " << narrow << " narrow");
  CHECK(20 * outside <= draws);
  CHECK(50 * untold <= draws);
  // And the warning is no habit: half of the draws have none, but for three standard deviations of so many tosses of a
  // coin, each sqrt(draws)/2.
  CHECK(narrow >= 0.5 * draws - 1.5 * std::sqrt(draws));
}

TEST_CASE("stations of a spline of clothoids, its joints among them, give that very spline") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const int draws = testing::thorough() ? 4 : 1;
  const int pieces = testing::thorough() ? 14 : 8;
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<ClothoidSegment> segments;
    double curvature = random.between(-0.08, 0.08);
    double slope = 0.4;
    for (int k = 0; k < pieces; ++k) {
      const double length = random.between(0.8, 8.0);
      // Turned back where the slope goes far.
      const double next = random.between(-0.08, 0.08) + (slope > 0.7 ? 0.05 : slope < 0.0 ? -0.05 : 0.0);
      segments.push_back({length, curvature, next});
      slope -= 0.5 * length * (curvature + next);
      curvature = next;
    }
    const ClothoidSpline drawn(Angle::from_radians(0.4), segments);
    std::vector<double> stations = {0.0};
    for (const double joint : drawn.breaks()) {
      const double from = stations.back();
      const int gaps = static_cast<int>(std::ceil((joint - from) / 0.4));
      for (int i = 1; i <= gaps; ++i)
        stations.push_back(i == gaps ? joint : from + (joint - from) * i / gaps);
    }
    std::vector<Vec2> points;
    for (const double s : stations) {
      const CenterlinePoint place = drawn.at(s);
      points.push_back({place.x, place.drop});
    }
    const FittedProfile profile(points);
    INFO("draw " << draw << ", " << points.size() << " points");
    CHECK(profile.length() == Approx(drawn.length()).epsilon(1e-8));
    double most = 0.0;
    for (int i = 0; i < 500; ++i) {
      const double s = i / 500.0;
      most = std::max(most, std::fabs(profile.at(s * profile.length()).curvature -
                                      drawn.at(s * drawn.length()).curvature));
    }
    CHECK(most <= 1e-5);
  }
}
