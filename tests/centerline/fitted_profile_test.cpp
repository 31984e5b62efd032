#include "glissade/centerline/fitted_profile.hpp"

#include "glissade/centerline/clothoid_spline.hpp"
#include "glissade/centerline/coulomb_brachistochrone.hpp"
#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/known_profiles.hpp"
#include "support/random.hpp"
#include "support/thorough.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace fitted_profile_test {

using namespace glissade;
using Catch::Matchers::Contains;
using testing::Random;

namespace {

/// Points at equal steps of arc length, each coordinate off by the noise.
std::vector<Vec2> sampled(const Centerline& curve, int count, double noise, Random& random) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const CenterlinePoint place = curve.at(curve.length() * (static_cast<double>(i) / (count - 1)));
    points.push_back({place.x + noise * bell(random), place.drop + noise * bell(random)});
  }
  return points;
}

double distance_to_chord(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 chord = to - from;
  const double share = std::clamp(dot(point - from, chord) / dot(chord, chord), 0.0, 1.0);
  return norm(point - (from + share * chord));
}

/// Nearest distance by looking at every chord of a fine polygon: no Newton step, no order of points.
double distance_by_looking(Vec2 point, const std::vector<Vec2>& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < polygon.size(); ++i) {
    nearest = std::min(nearest, distance_to_chord(point, polygon[i], polygon[i + 1]));
  }
  return nearest;
}

std::vector<Vec2> polygon_of(const Centerline& curve, int chords) {
  std::vector<Vec2> polygon;
  for (int i = 0; i <= chords; ++i) {
    const CenterlinePoint place = curve.at(curve.length() * (static_cast<double>(i) / chords));
    polygon.push_back({place.x, place.drop});
  }
  return polygon;
}

ClothoidSpline easy_track() {
  return {Angle::from_degrees(60.0),
          {{2.0, 0.0, 0.0}, {1.0, 0.0, 0.4}, {2.0, 0.4, 0.4}, {1.0, 0.4, -0.1}, {2.0, -0.1, -0.1}}};
}

std::string refusal(std::vector<Vec2> points, const ProfileFit& fit = {}) {
  try {
    const FittedProfile profile(std::move(points), fit);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("points of a straight line or an arc give that line or arc") {
  Random random(1);
  const double curvature = GENERATE(0.0, 0.3, -0.2);
  const ClothoidSpline truth(Angle::from_degrees(40.0), {{3.0, curvature, curvature}});
  const int count = GENERATE(3, 4, 7, 8, 20, 100);
  INFO(count << " points, curvature " << curvature);
  const FittedProfile profile(sampled(truth, count, 0.0, random));
  CHECK(profile.max_deviation() < 1e-13);
  CHECK(profile.length() == Approx(truth.length()).epsilon(1e-12));
  for (const double share : {0.0, 0.3, 1.0}) {
    const CenterlinePoint place = profile.at(share * profile.length());
    CHECK(place.slope_angle == Approx(truth.slope_angle(share * truth.length())).margin(1e-9));
    CHECK(place.curvature == Approx(curvature).margin(1e-7));
  }
}

TEST_CASE("noise of points is smoothed away, and the deviations tell how large it was") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr double kNoise = 1e-3;
  const ClothoidSpline truth = easy_track();
  const FittedProfile profile(sampled(truth, 100, kNoise, random));
  // 300 draws: their root mean square lies within five of its standard errors, 1/sqrt(600); the fit takes
  // some.
  CHECK(profile.rms_deviation() == Approx(kNoise).epsilon(0.35));
  CHECK(profile.max_deviation() < 6.0 * kNoise);
  // Nearer to the truth than the points are.
  const std::vector<Vec2> polygon = polygon_of(truth, 2000);
  for (int i = 5; i <= 95; ++i) {
    const CenterlinePoint place = profile.at(profile.length() * i / 100.0);
    const Vec2 from_start{place.x + profile.points().front().x, place.drop};
    CHECK(distance_by_looking(from_start, polygon) < 5.0 * kNoise);
  }
}

TEST_CASE("deviations are the nearest distances that a search over the whole curve finds") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const double noise = GENERATE(1e-4, 5e-3, 1.5e-2);
  INFO("noise " << noise);
  const FittedProfile profile(sampled(easy_track(), 80, noise, random));
  constexpr int kChords = 20000;
  const std::vector<Vec2> polygon = polygon_of(profile, kChords);
  const double chord = profile.length() / kChords;
  double largest = 0.0;
  for (std::size_t i = 0; i < profile.points().size(); ++i) {
    const Vec2 point = profile.points()[i];
    const PointDeviation& told = profile.deviations()[i];
    const double looked = distance_by_looking(point, polygon);
    largest = std::max(largest, looked);
    // A chord lies within chord^2 / 8 of the arc for curvatures up to 1 1/m.
    CHECK(std::fabs(std::fabs(told.deviation) - looked) < chord * chord);
    const CenterlinePoint place = profile.at(told.arc_length);
    CHECK(norm(point - Vec2{place.x, place.drop}) == Approx(std::fabs(told.deviation)).margin(1e-14));
    const bool below = dot(point - Vec2{place.x, place.drop},
                           {-std::sin(place.slope_angle), std::cos(place.slope_angle)}) > 0.0;
    CHECK(below == (told.deviation > 0.0));
  }
  CHECK(profile.max_deviation() == Approx(largest).margin(chord * chord));
}

TEST_CASE("exact points of the fastest track bring its curve back, closer as they get denser") {
  Random random(1);
  const CoulombBrachistochrone truth({10.0, 5.0}, Friction::from_coefficient(0.2), 9.81);
  const FittedProfile coarse(sampled(truth, 20, 0.0, random));
  const FittedProfile dense(sampled(truth, 80, 0.0, random));
  CHECK(dense.max_deviation() < 2e-6 * truth.length());
  CHECK(dense.length() == Approx(truth.length()).epsilon(2e-5));
  CHECK(std::fabs(dense.length() - truth.length()) < 0.5 * std::fabs(coarse.length() - truth.length()));
  // Between the points, too: away from the start, where curvature has no bound.
  const auto farthest_between = [&](const FittedProfile& profile) {
    const std::vector<Vec2> polygon = polygon_of(profile, 20000);
    double farthest = 0.0;
    for (int i = 100; i < 1000; ++i) {
      const CenterlinePoint place = truth.at(truth.length() * (i / 1000.0));
      const double away = distance_by_looking({place.x, place.drop}, polygon);
      farthest = std::max(farthest, away);
    }
    return farthest;
  };
  CHECK(farthest_between(coarse) < 1e-2);
  CHECK(farthest_between(dense) < 1e-4);
}

TEST_CASE("of thousands of points every one is measured, and the noise averages out") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr double kNoise = 1e-3;
  constexpr int kCount = 2500;
  const ClothoidSpline truth(Angle::from_degrees(70.0), {{4.0, 0.25, 0.25}});
  const FittedProfile profile(sampled(truth, kCount, kNoise, random));
  REQUIRE(profile.deviations().size() == static_cast<std::size_t>(kCount));
  CHECK(profile.rms_deviation() == Approx(kNoise).epsilon(0.1));
  for (const double share : {0.25, 0.5, 0.75}) {
    const double slope = truth.slope_angle(share * truth.length());
    CHECK(profile.slope_angle(share * profile.length()) == Approx(slope).margin(0.01));
  }
}

TEST_CASE("a largest deviation that is asked for is kept, by the smoothest curve that does") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const std::vector<Vec2> points = sampled(easy_track(), 60, 2e-3, random);
  const FittedProfile loose(points, {0.02});
  const FittedProfile tight(points, {0.002});
  CHECK(loose.max_deviation() <= 0.02);
  CHECK(loose.max_deviation() > 0.01);
  CHECK(tight.max_deviation() <= 0.002);
  const auto sharpest_change = [](const FittedProfile& profile) {
    double sharpest = 0.0;
    for (const ClothoidSegment& segment : profile.curve().segments()) {
      sharpest =
          std::max(sharpest, std::fabs(segment.exit_curvature - segment.entry_curvature) / segment.length);
    }
    return sharpest;
  };
  CHECK(sharpest_change(loose) < sharpest_change(tight));
}

TEST_CASE("a deviation that no curve found keeps is refused, with the least that one does") {
  // More points than knots, and noise in all of them.
  Random random(3);
  CHECK_THAT(refusal(sampled(easy_track(), 140, 1e-3, random), {1e-9}),
             Contains("max_deviation: no smooth curve was found within") && Contains("of all 140 points") &&
                 Contains("the nearest comes within"));
}

TEST_CASE("a profile that leads to the left is mirrored, and begins where its first point is") {
  Random random(1);
  std::vector<Vec2> points = sampled(easy_track(), 40, 0.0, random);
  const FittedProfile right(points);
  for (Vec2& point : points) point = {7.0 - point.x, point.y - 3.0};
  const FittedProfile left(points);
  CHECK(left.at(0.0).x == 0.0);
  CHECK(left.at(0.0).drop == 0.0);
  CHECK(left.length() == Approx(right.length()).epsilon(1e-9));
  CHECK(left.endpoints().run == Approx(right.endpoints().run).epsilon(1e-9));
}

TEST_CASE("a wavy profile keeps its waves, however many and however sampled") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr double kRun = 100.0;
  constexpr double kHeight = 2.0;
  for (const int count : {40, 120, 400}) {
    for (const double periods : {1.0, 2.0, 3.0, 5.0, 8.0}) {
      if (count < 8.0 * periods) continue;
      for (const double noise : {0.0, 0.02}) {
        // Many points take long: elsewhere than in CI some waves with noise, few of them where points are most. Exact
        // points of many waves are those of another test.
        const bool is_quick = count == 40 || (count == 120 && periods == 5.0 && noise > 0.0) ||
                              (count == 400 && periods < 2.0 && noise > 0.0);
        if (!is_quick && !testing::thorough()) continue;
        const auto wave = [&](double x) {
          return 0.3 * x + kHeight * std::sin(2.0 * std::numbers::pi * periods * x / kRun);
        };
        std::vector<Vec2> points;
        for (int i = 0; i < count; ++i) {
          const double x = kRun * i / (count - 1);
          points.push_back({x, wave(x) + noise * bell(random)});
        }
        const FittedProfile profile(points);
        INFO(count << " points, " << periods << " periods, noise " << noise);
        // Between points that are few for their waves a curve of linear curvature may pass a crest by 1 %.
        CHECK(profile.max_deviation() <= 5.0 * noise + 1e-3 * kHeight);
        CHECK_FALSE(profile.leaves_out_much());
        for (int i = 0; i <= 300; ++i) {
          const CenterlinePoint place = profile.at(profile.length() * (i / 300.0));
          const double start = points.front().y;
          CHECK(std::fabs(place.drop + start - wave(place.x)) <= 6.0 * noise + 0.01 * kHeight);
        }
      }
    }
  }
}

TEST_CASE(
    "exact points of a wave are followed, from five a period on, and what few of them leave open is told") {
  constexpr double kRun = 100.0;
  constexpr double kHeight = 2.0;
  for (const int each : {5, 6, 8, 12, 16}) {
    for (const int periods : {1, 3, 5, 6, 8, 10}) {
      if (each * periods > 40 && !testing::thorough()) continue;
      for (const double phase : {0.0, 0.4}) {
        // The dearest at one phase.
        if (each * periods > 100 && phase > 0.0) continue;
        const auto wave = [&](double x) {
          return 0.5 * x + kHeight * std::sin(2.0 * std::numbers::pi * periods * x / kRun + phase);
        };
        std::vector<Vec2> points;
        const int count = each * periods;
        for (int i = 0; i < count; ++i)
          points.push_back({kRun * i / (count - 1), wave(kRun * i / (count - 1))});
        const FittedProfile profile(points);
        INFO(each << " points a period, " << periods << " periods, phase " << phase);
        CHECK(profile.max_deviation() <= 0.01 * kHeight);
        CHECK_FALSE(profile.leaves_out_much());
        double off = 0.0;
        for (int i = 0; i <= 1000; ++i) {
          const CenterlinePoint place = profile.at(profile.length() * (i / 1000.0));
          const double x = place.x;
          const double away = place.drop + points.front().y - wave(x);
          off = std::max(off, std::fabs(away) * std::cos(place.slope_angle));
        }
        CHECK(off <= (each < 8 ? 0.15 : count < 20 ? 0.03 : 0.004) * kHeight);
        CHECK(off <= 4.0 * profile.between_points() + profile.max_deviation());
        if (each <= 5 || off > 0.04 * kHeight) CHECK(profile.leaves_gaps());
        if (each >= 12) CHECK_FALSE(profile.leaves_gaps());
      }
    }
  }
}

TEST_CASE("exact points are followed to millimetres however many they are and however many waves they show") {
  constexpr double kRun = 100.0;
  constexpr double kHeight = 2.0;
  const double turn = 2.0 * std::numbers::pi;
  struct Wave {
    const char* name;
    double periods;
    double chirp;  // the share by which the last wave is shorter than the middle one
  };
  for (const Wave& wave : {Wave{"sine", 10.0, 0.0}, Wave{"sine", 20.0, 0.0}, Wave{"chirp", 12.0, 0.6}}) {
    for (const int count : {160, 170, 200, 400, 1000, 2000}) {
      // Elsewhere than in CI of each wave what takes least, many points of one and few of the others.
      const bool is_quick = (wave.periods < 11.0 && count == 1000) || (wave.chirp > 0.0 && count == 160) ||
                            (wave.periods > 19.0 && count == 170);
      if (!is_quick && !testing::thorough()) continue;
      const auto height = [&](double x) {
        const double u = x / kRun;
        return 0.5 * x + kHeight * std::sin(turn * wave.periods * u * (1.0 - wave.chirp + wave.chirp * u));
      };
      std::vector<Vec2> points;
      for (int i = 0; i < count; ++i) {
        const double x = kRun * i / (count - 1);
        points.push_back({x, height(x)});
      }
      const FittedProfile profile(points);
      INFO(wave.name << ", " << wave.periods << " periods, " << count << " points");
      CHECK(profile.max_deviation() <= 1e-4);
      CHECK_FALSE(profile.leaves_out_much());
      CHECK_FALSE(profile.leaves_gaps());
      double off = 0.0;
      for (int i = 0; i <= 4000; ++i) {
        const CenterlinePoint place = profile.at(std::min(profile.length(), profile.length() * (i / 4000.0)));
        off = std::max(off, std::fabs(place.drop - height(place.x)) * std::cos(place.slope_angle));
      }
      CHECK(off <= (count < 11.0 * wave.periods * (1.0 + wave.chirp) ? 0.005 : 0.001));
    }
  }
}

TEST_CASE("the smallest radius of a wave is known from nine points a period on, and told as open below") {
  constexpr double kRun = 100.0;
  constexpr double kHeight = 2.0;
  const double turn = 2.0 * std::numbers::pi;
  for (const double periods : {12.0, 20.0, 30.0, 50.0}) {
    for (const int each : {6, 7, 8, 9, 10, 12, 16}) {
      const int count = each * static_cast<int>(periods);
      // Beyond, searches for few pieces take long, and tell the same.
      if (count > 500 || (count == 300 && each == 10)) continue;
      const bool is_quick = periods == 20.0 && (each == 6 || each == 9);
      if (!is_quick && !testing::thorough()) continue;
      const double wave = turn * periods / kRun;
      const auto height = [&](double x) { return 0.5 * x + kHeight * std::sin(wave * x + 0.4); };
      const auto curvature = [&](double x) {
        const double slope = 0.5 + kHeight * wave * std::cos(wave * x + 0.4);
        return std::fabs(kHeight * wave * wave * std::sin(wave * x + 0.4)) /
               std::pow(1.0 + slope * slope, 1.5);
      };
      std::vector<Vec2> points;
      for (int i = 0; i < count; ++i)
        points.push_back({kRun * i / (count - 1), height(kRun * i / (count - 1))});
      double largest = 0.0;
      for (int i = 0; i <= 100000; ++i) largest = std::max(largest, curvature(kRun * i / 100000.0));
      const FittedProfile profile(points);
      double own = 0.0;
      for (int i = 0; i <= 20000; ++i) {
        const double s = std::min(profile.length(), profile.length() * (i / 20000.0));
        own = std::max(own, std::fabs(profile.at(s).curvature));
      }
      INFO(each << " points a period, " << periods << " periods: radius " << 1.0 / own << " m for "
                << 1.0 / largest);
      CHECK(profile.max_deviation() <= 0.01 * kHeight);
      CHECK(own == Approx(largest).epsilon(each < 8 ? 0.08 : 0.035));
      // Seven and eight a wave lie at the edge.
      if (each <= 6) CHECK(profile.leaves_radius_open());
      if (each >= 9) CHECK_FALSE(profile.leaves_radius_open());
    }
  }
}

TEST_CASE("waves rounded to millimetres give their smallest radius back, and it lies in the range told") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  const std::vector<std::pair<int, int>> kinds = {{3, 120}, {5, 60},  {5, 120}, {5, 200}, {8, 120},
                                                  {8, 200}, {8, 300}, {8, 400}, {9, 400}, {12, 200}};
  for (const auto& [periods, count] : kinds) {
    const bool is_quick = count <= 200 || (periods == 8 && count == 400);
    if (!is_quick && !testing::thorough()) continue;
    const testing::RoundedWave wave{periods, count, random.between(0.0, 6.28)};
    INFO(periods << " periods, " << count << " points, phase " << wave.phase);
    const FittedProfile profile(wave.points());
    const double largest = testing::largest_curvature(profile.curve());
    const double truth = 1.0 / wave.smallest_radius();
    // Of several crests the one that noise sharpens most: measured up to 6 %, and 10 % where points are few to a wave. In one of a
    // hundred waves a short piece at an end has 30 % more, which is told.
    const double off = std::fabs(largest / truth - 1.0);
    CHECK(off < 0.35);
    CHECK((off < (count < 20 * periods ? 0.15 : 0.09) || profile.leaves_radius_open()));
    REQUIRE(profile.largest_curvature());
    CHECK(profile.largest_curvature()->least < 1.01 * truth);
    CHECK(profile.largest_curvature()->greatest > 0.99 * truth);
    CHECK_FALSE(profile.leaves_pattern());
    CHECK(profile.rms_deviation() < 0.45e-3);
  }
}

TEST_CASE("a wave on so few points that curves through them differ is told to leave gaps, or is followed") {
  constexpr double kRun = 100.0;
  constexpr double kHeight = 2.0;
  // Where cubics and quintics over arc length pass each other by 9 mm, but the wave by 154 mm: 16 points, three waves.
  for (const int count : {10, 12, 14, 16, 18, 20, 21, 24, 27, 30, 36}) {
    for (const int periods : {1, 2, 3, 4, 5, 6}) {
      const double each = (count - 1.0) / periods;
      if (each < 4.5 || each > 12.0) continue;
      const auto wave = [&](double x) {
        return 0.3 * x - kHeight * std::sin(2.0 * std::numbers::pi * periods * x / kRun);
      };
      std::vector<Vec2> points;
      for (int i = 0; i < count; ++i)
        points.push_back({kRun * i / (count - 1), wave(kRun * i / (count - 1))});
      const FittedProfile profile(points);
      double off = 0.0;
      for (int i = 0; i <= 1000; ++i) {
        const CenterlinePoint place = profile.at(profile.length() * (i / 1000.0));
        off = std::max(off, std::fabs(place.drop - wave(place.x)) * std::cos(place.slope_angle));
      }
      INFO(count << " points, " << periods << " periods, off by " << off << ", told "
                 << profile.between_points());
      // 12 points of two waves: 50 mm; 8 of one: 12 mm, which is told but no warning.
      if (off > 0.02 * kHeight) CHECK((profile.leaves_gaps() || profile.leaves_out_much()));
      CHECK(off <= 4.0 * profile.between_points() + 2.0 * profile.max_deviation() + 1e-3 * kHeight);
    }
  }
}

TEST_CASE("noise on few points is not followed as if it were their shape") {
  Random random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  constexpr double kNoise = 0.02;
  int followed = 0;
  int told = 0;
  for (const int count : {20, 24, 30, 40}) {
    for (int draw = 0; draw < 10; ++draw) {
      std::vector<Vec2> points;
      for (int i = 0; i < count; ++i) {
        const double x = 100.0 * i / (count - 1);
        points.push_back({x, 0.3 * x + 2.0 * std::sin(0.02 * std::numbers::pi * x) + kNoise * bell(random)});
      }
      const FittedProfile profile(points);
      followed += profile.max_deviation() < 0.1 * kNoise ? 1 : 0;
      told += profile.leaves_gaps() || profile.leaves_out_much() ? 1 : 0;
    }
  }
  // Two of a hundred of 20 to 24 points are: nothing else would follow a shape that few points show.
  CHECK(followed <= 4);
  // Of a hundred one is warned of that needs no warning.
  CHECK(told <= 3);
}

TEST_CASE("a point far off the others is told, whether they are exact or scatter") {
  const ClothoidSpline truth(Angle::from_degrees(35.0), {{50.0, 0.0, 0.0}, {50.0, 1.0 / 60.0, 1.0 / 60.0}});
  for (const double noise : {0.0, 0.002}) {
    INFO("noise " << noise);
    Random random(5);
    std::vector<Vec2> points = sampled(truth, 100, noise, random);
    CHECK_FALSE(FittedProfile(points).farthest_stands_out());
    points[33].y += 0.1;
    const FittedProfile slipped(points);
    REQUIRE(slipped.farthest_stands_out());
    CHECK(*slipped.farthest_stands_out() > 6.0);
    CHECK(slipped.farthest_point() == 33U);
    CHECK_FALSE(FittedProfile(points, {0.2}).farthest_stands_out());
  }
}

namespace {

/// A wave on a slope.
struct SlopedWave {
  double waves;
  int points_each;
  double height;
  double run;
  double phase;
  double slope;

  [[nodiscard]] double number() const { return 2.0 * std::numbers::pi * waves / run; }
  [[nodiscard]] std::vector<Vec2> points() const {
    std::vector<Vec2> all;
    const int last = static_cast<int>(std::lround(waves * points_each));
    for (int i = 0; i <= last; ++i) {
      const double x = run * i / last;
      all.push_back({x, slope * x - height * std::sin(number() * x + phase)});
    }
    return all;
  }
  [[nodiscard]] double largest_curvature() const {
    double most = 0.0;
    for (int i = 0; i <= 40'000; ++i) {
      const double turn = number() * run * i / 40'000.0 + phase;
      const double rise = slope - height * number() * std::cos(turn);
      const double bend = height * number() * number() * std::sin(turn);
      most = std::max(most, std::fabs(bend) / std::pow(1.0 + rise * rise, 1.5));
    }
    return most;
  }
};

double largest_curvature_of(const FittedProfile& profile) {
  double most = 0.0;
  for (const ClothoidSegment& segment : profile.curve().segments())
    most = std::max({most, std::fabs(segment.entry_curvature), std::fabs(segment.exit_curvature)});
  return most;
}

}  // namespace

TEST_CASE("no pieces stand for exact points of a wave, which a smooth curve meets") {
  // A straight of half a metre at the end that is none, or a bend: radii were 4 to 66 % too small.
  int number = 0;
  for (const SlopedWave& wave :
       {SlopedWave{7.0, 18, 0.8, 126.0, 5.2, 0.4}, SlopedWave{7.0, 18, 0.84, 128.0, 5.2, 0.38},
        SlopedWave{7.0, 18, 0.8, 126.0, 1.5, 0.4}, SlopedWave{10.0, 16, 1.0, 100.0, 0.0, 0.4},
        SlopedWave{13.0, 20, 0.5, 50.0, 0.3, 0.2}, SlopedWave{5.0, 25, 1.461, 140.4, 1.278, 0.204}}) {
    // Every other one, elsewhere than in CI.
    if (number++ % 2 == 1 && !testing::thorough()) continue;
    const FittedProfile profile(wave.points());
    const double truth = wave.largest_curvature();
    INFO(wave.waves << " waves of " << wave.points_each << " points, phase " << wave.phase << ": radius "
                    << 1.0 / largest_curvature_of(profile) << " m for " << 1.0 / truth);
    CHECK(largest_curvature_of(profile) == Approx(truth).epsilon(5e-3));
    CHECK(profile.max_deviation() < 1e-5);
    REQUIRE(profile.largest_curvature());
    CHECK(profile.largest_curvature()->least <= 1.005 * truth);
    CHECK(profile.largest_curvature()->greatest >= 0.995 * truth);
    CHECK_FALSE(profile.leaves_radius_open());
  }
}

TEST_CASE(
    "a smooth curve that misses more of a wave than rounding leaves gives way to one through the points") {
  // Radii were 30 and 1.2 % too small: what so many knots miss passed for the noise of the points.
  int number = 0;
  for (const auto& [wave, last_place] :
       {std::pair{SlopedWave{4.983494, 33, 0.07888377, 4.4266047, 4.64010932, 0.2949699}, 1e-6},
        std::pair{SlopedWave{5.95686985, 22, 3.02598169, 226.0271693, 0.2557968, 0.17214}, 1e-4}}) {
    if (number++ > 0 && !testing::thorough()) continue;
    std::vector<Vec2> points = wave.points();
    for (Vec2& point : points)
      point = {std::round(point.x / last_place) * last_place, std::round(point.y / last_place) * last_place};
    const FittedProfile profile(points);
    const double truth = wave.largest_curvature();
    INFO(wave.waves << " waves of " << wave.points_each << " points: radius "
                    << 1.0 / largest_curvature_of(profile) << " m for " << 1.0 / truth);
    CHECK(largest_curvature_of(profile) == Approx(truth).epsilon(0.005));
    CHECK(profile.rms_deviation() < last_place);
  }
}

TEST_CASE("no bends with jumps stand for a scattered wave that a smooth curve meets with as few numbers") {
  // Radii were 5.4 and 2.8 % too small, of a range that held the true ones.
  int number = 0;
  for (const auto& [wave, tolerance] :
       {std::pair{SlopedWave{6.18546035, 47, 0.0868914179, 25.8368723, 3.5738258, 0.0615481}, 0.02},
        std::pair{SlopedWave{7.76611116, 242, 1.14844799, 74.2175032, 2.0500992, 0.289365}, 0.02}}) {
    if (number++ > 0 && !testing::thorough()) continue;
    std::vector<Vec2> points = wave.points();
    for (Vec2& point : points) point = {std::round(point.x * 1e4) / 1e4, std::round(point.y * 1e4) / 1e4};
    const FittedProfile profile(points);
    const double truth = wave.largest_curvature();
    INFO(wave.waves << " waves of " << wave.points_each << " points: radius "
                    << 1.0 / largest_curvature_of(profile) << " m for " << 1.0 / truth);
    CHECK(largest_curvature_of(profile) == Approx(truth).epsilon(tolerance));
    REQUIRE(profile.largest_curvature());
    CHECK(profile.largest_curvature()->least <= truth);
    CHECK(profile.largest_curvature()->greatest >= truth);
  }
}

TEST_CASE("exact points of a wave that foretell each other leave no sharp bend open between them") {
  // "2.14 mm to 538 mm describe the points about as well": some of the pieces that met the wave held few points.
  const SlopedWave wave{4.416197, 187, 0.0586095781, 4.78286955, 0.72118377, 0.0950338};
  const FittedProfile profile(wave.points());
  const double truth = wave.largest_curvature();
  REQUIRE(profile.largest_curvature());
  INFO("radius " << 1.0 / truth << " m, told " << radius_range_text(*profile.largest_curvature()));
  CHECK(largest_curvature_of(profile) == Approx(truth).epsilon(1e-3));
  CHECK(profile.largest_curvature()->least <= 1.001 * truth);
  CHECK(profile.largest_curvature()->greatest >= 0.999 * truth);
  CHECK_FALSE(profile.leaves_radius_open());
}

TEST_CASE(
    "what few exact points of a wave leave open of the smallest radius holds the true one where an end is "
    "sharpest") {
  for (const SlopedWave& wave :
       {SlopedWave{7.0, 6, 0.04, 11.33, 4.942, 0.628}, SlopedWave{10.0, 5, 0.7285, 103.1, 6.279, 0.487},
        SlopedWave{10.0, 10, 0.7641, 69.84, 1.505, 0.638}}) {
    const FittedProfile profile(wave.points());
    const double truth = wave.largest_curvature();
    REQUIRE(profile.largest_curvature());
    INFO(wave.waves << " waves: radius " << 1.0 / truth << " m, told "
                    << radius_range_text(*profile.largest_curvature()));
    CHECK(profile.leaves_radius_open());
    CHECK(profile.largest_curvature()->least <= 1.02 * truth);
    CHECK(profile.largest_curvature()->greatest >= 0.98 * truth);
  }
}

TEST_CASE("round numbers of x are no rounding where z has all its digits") {
  // Every tenth of a wave a round number, to three decimals, and z is what the wave has there.
  const SlopedWave wave{10.0, 16, 1.0, 100.0, 0.0, 0.4};
  const FittedProfile profile(wave.points());
  CHECK(profile.max_deviation() < 1e-9);
}

TEST_CASE("a radius that fewer points show than it has unknowns is told as open, or is the true one") {
  struct Tight {
    double slope;
    int count;
    std::vector<ClothoidSegment> segments;
  };
  std::vector<Tight> all = {{0.79751, 20, {{1.34325, 0.0, 0.0}, {0.14452, 1.0 / 0.5509, 1.0 / 0.5509}}},
                            {0.84813,
                             40,
                             {{19.38, 0.0, 0.0},
                              {6.37, 1.0 / 33.1, 1.0 / 33.1},
                              {0.615, 1.0 / 6.81, 1.0 / 6.81},
                              {12.26, 0.0, 0.0}}}};
  for (const double length : {0.3, 0.8, 1.2, 1.7, 2.8}) {
    all.push_back({0.7, 40, {{20.0, 0.0, 0.0}, {length, 0.1, 0.1}, {19.0 - length, 0.0, 0.0}}});
    all.push_back({0.7, 40, {{39.37 - length, 0.0, 0.0}, {length, 0.1, 0.1}}});
  }
  Random random(1);
  for (const Tight& tight : all) {
    const ClothoidSpline drawn(Angle::from_radians(tight.slope), tight.segments);
    const FittedProfile profile(sampled(drawn, tight.count, 0.0, random));
    double truth = 0.0;
    for (const ClothoidSegment& segment : tight.segments) truth = std::max(truth, segment.entry_curvature);
    INFO(tight.count << " points on " << drawn.length() << " m, radius "
                     << 1.0 / largest_curvature_of(profile) << " m for " << 1.0 / truth);
    const bool found = std::fabs(largest_curvature_of(profile) / truth - 1.0) < 0.02;
    CHECK((found || profile.leaves_radius_open()));
    if (tight.count == 20) CHECK(found);
    if (tight.count == 20 || tight.segments[1].length > 2.0)
      CHECK_FALSE((tight.segments.size() < 4 && profile.leaves_radius_open()));
    if (found) continue;
    REQUIRE(profile.largest_curvature());
    CHECK(profile.largest_curvature()->least <= truth);
    CHECK(profile.largest_curvature()->greatest >= truth);
  }
}

TEST_CASE("a profile that runs back is refused by the number of the point") {
  std::vector<Vec2> points;
  for (int i = 0; i < 60; ++i) points.push_back({2.5 * i - (i == 31 ? 4.0 : 0.0), 1.0 * i});
  const auto fault = profile_fault(points);
  REQUIRE(fault);
  CHECK(fault->point == 31U);
  CHECK_THAT(fault->issue.what, Contains("runs back here"));
}

TEST_CASE("what no track can follow is refused by the number of the point") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(refusal({}), Contains("points: there are no points") && Contains("at least 3"));
  CHECK_THAT(refusal({{0.0, 0.0}, {1.0, 1.0}}), Contains("there are 2 points") && Contains("straight"));
  CHECK_THAT(refusal({{0.0, 0.0}, {1.0, kNan}, {2.0, 1.0}}),
             Contains("point 2 (1, nan)") && Contains("finite"));
  CHECK_THAT(refusal({{0.0, 0.0}, {1.0, 1.0}, {1.0, 1.0}, {2.0, 1.0}}),
             Contains("point 3 (1, 1)") && Contains("repeats the point before it"));
  CHECK_THAT(refusal({{0.0, 0.0}, {2.0, 1.0}, {1.0, 0.6}, {3.0, 1.0}}),
             Contains("point 2 (2, 1)") && Contains("turns back on itself"));
  CHECK_THAT(refusal({{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}, {-1.0}), Contains("max_deviation: -1 m"));
}

TEST_CASE("nothing is left out of exact points of a straight, upright or not") {
  for (const Vec2 way : {Vec2{0.0, 1.0}, Vec2{3.0, 1.0}, Vec2{1.0 / 3.0, 0.1}}) {
    std::vector<Vec2> points;
    for (int i = 0; i < 7; ++i) points.push_back(0.7 * i * way);
    const FittedProfile profile(points);
    CHECK_FALSE(profile.leaves_out_much());
    CHECK(profile.rms_deviation() < 1e-14);
  }
}

}  // namespace fitted_profile_test
