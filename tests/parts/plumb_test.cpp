// Levels plumb below places of a track: held against the distance that defines the line, and against what stands there.

#include "parts/curves/plumb.hpp"

#include "glissade/core/math.hpp"
#include "glissade/parts/master_curve.hpp"

#include "parts/curves/offset_line.hpp"
#include "parts/random_tracks.hpp"
#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace plumb_test {

namespace {

using namespace glissade;
using parts::frame_at;
using parts::level_below;

/// Height at an x of the points square below the track, where these go forwards along it: by bisecting the place.
double bisected_level(const ArcSpline& track, double depth, double x) {
  const auto below = [&](double s) {
    const parts::TrackFrame at = frame_at(track, s);
    return at.at - depth * at.up;
  };
  double low = 0.0;
  double high = track.length();
  for (int round = 0; round < 100; ++round) {
    const double middle = 0.5 * (low + high);
    (below(middle).x < x ? low : high) = middle;
  }
  return below(0.5 * (low + high)).y;
}

/// Distance of a point from the track, from a scan and bisection of the slope of the distance.
double distance(const ArcSpline& track, Vec2 point) {
  constexpr int kPlaces = 400;
  double least = 1e9;
  const auto along = [&](double s) { return dot(point - frame_at(track, s).at, frame_at(track, s).along); };
  for (int k = 0; k < kPlaces; ++k) {
    double low = track.length() * k / kPlaces;
    double high = track.length() * (k + 1) / kPlaces;
    least = std::min(least, norm(point - frame_at(track, low).at));
    if (!(along(low) >= 0.0 && along(high) <= 0.0)) continue;
    for (int round = 0; round < 80; ++round) {
      const double middle = 0.5 * (low + high);
      (along(middle) >= 0.0 ? low : high) = middle;
    }
    least = std::min(least, norm(point - frame_at(track, low).at));
  }
  return std::min(least, norm(point - frame_at(track, track.length()).at));
}

}  // namespace

TEST_CASE("plumb: below a straight of a slope the level is depth / cos(slope) below the place") {
  for (const double degrees : {0.0, 11.0, 35.0, 60.0, -20.0}) {
    const double slope = degrees * std::numbers::pi / 180.0;
    const Vec2 end{20.0 * math::cos(slope), -20.0 * math::sin(slope)};
    const ArcSpline track({{{{0.0, 0.0}, 0.0}, {end, 0.0}}, false});
    const auto line = parts::offset_line(track, {0.0, 20.0}, -0.8);
    REQUIRE(line);
    const Vec2 at = 0.5 * end;
    const auto level = level_below(*line, at);
    REQUIRE(level);
    CHECK(std::fabs(*level - (at.y - 0.8 / math::cos(slope))) < 1e-12);
    // The line ends square to the track: downhill short of its finish.
    CHECK(level_below(*line, end).has_value() == (degrees <= 0.0));
    CHECK(level_below(*line, {0.0, 0.0}).has_value() == (degrees >= 0.0));
  }
}

TEST_CASE(
    "plumb: of random tracks the level is that of the line at the depth, told wherever the line passes and "
    "nowhere else") {
  testing::Random random(20'261);
  std::size_t told = 0;
  std::size_t beyond = 0;
  for (int n = 0; n < 40; ++n) {
    const ClothoidSpline drawn = testing::random_track(random, {.steepest = 55.0});
    const ArcSpline track = *fit_arcs(drawn, {1e-4}).spline;
    const double depth = random.between(0.01, 1.2);
    bool forwards = true;
    for (int k = 0; k <= 200; ++k)
      forwards = forwards && frame_at(track, track.length() * k / 200.0).along.x > 0.1;
    const auto line = parts::offset_line(track, {0.0, track.length()}, -depth);
    if (!line || !forwards) continue;
    const bool folds = parts::folds(track, {0.0, track.length()}, -depth);
    for (int k = 0; k <= 20; ++k) {
      const Vec2 at = frame_at(track, std::min(track.length(), track.length() * k / 20.0)).at;
      const auto level = level_below(*line, at);
      INFO("track " << n << ", x " << at.x << ", depth " << depth);
      const double from = line->vertices.front().at.x;
      const double to = line->vertices.back().at.x;
      if (std::min(std::fabs(at.x - from), std::fabs(at.x - to)) < 1e-6) continue;
      REQUIRE(level.has_value() == (at.x > from && at.x < to));
      if (!level) {
        ++beyond;
        continue;
      }
      ++told;
      if (!folds) CHECK(std::fabs(*level - bisected_level(track, depth, at.x)) < parts::kPlumbAccuracy);
      CHECK(std::fabs(distance(track, {at.x, *level}) - depth) < 1e-9);
    }
  }
  CHECK(told > 300);
  CHECK(beyond > 20);
}

TEST_CASE("plumb: arcs of any radius are as exact as lines") {
  for (const double radius : {2.0, 50.0, 1e4, 1e7, 1e10}) {
    for (const double sign : {1.0, -1.0}) {
      const double bulge = sign * math::tan(0.25 * 1.0 / radius);
      const ArcPath line{{{{0.0, 0.0}, bulge}, {{1.0, -0.5}, 0.0}}, false};
      const auto level = level_below(line, {0.5, 1.0});
      REQUIRE(level);
      // The arc lies off the middle of its chord by its rise, which the plumb line meets near there.
      const double rise = 0.5 * bulge * std::sqrt(1.25);
      CHECK(*level == Approx(-0.25 - rise * std::sqrt(1.25)).margin(0.6 * rise * rise + 1e-15));
    }
  }
}

TEST_CASE("plumb: the place of a track at a distance is one there, the nearest to what is asked") {
  testing::Random random(7);
  for (int n = 0; n < 10; ++n) {
    const ClothoidSpline drawn = testing::random_track(random, {.steepest = 50.0});
    const ArcSpline track = *fit_arcs(drawn, {1e-4}).spline;
    const double s = random.between(0.0, track.length());
    if (!(frame_at(track, s).along.x > 0.1)) continue;
    const auto place = parts::place_at_run(track, track.at(s).x, s);
    REQUIRE(place);
    CHECK(std::fabs(*place - s) < 1e-9);
    CHECK_FALSE(parts::place_at_run(track, -1.0, 0.0));
  }
}

}  // namespace plumb_test
