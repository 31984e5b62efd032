#include "glissade/centerline/drawn_track.hpp"

#include "glissade/centerline/in_run.hpp"
#include "glissade/core/error.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <boost/math/quadrature/gauss_kronrod.hpp>

using namespace glissade;

namespace {

double sign(testing::Random& random) {
  return random.integer(0, 1) == 0 ? 1.0 : -1.0;
}

CubicSegment random_cubic(testing::Random& random) {
  return {Angle::from_degrees(sign(random) * random.between(0.5, 50.0)), random.between(0.3, 30.0),
          random.integer(0, 1) == 0};
}

std::vector<TrackSegment> random_segments(testing::Random& random) {
  std::vector<TrackSegment> segments;
  const int count = random.integer(1, 6);
  for (int i = 0; i < count; ++i) {
    if (random.integer(0, 1) == 0) {
      segments.emplace_back(random_cubic(random));
    } else {
      segments.emplace_back(
          ClothoidSegment{random.between(0.2, 5.0), random.between(-0.2, 0.2), random.between(-0.2, 0.2)});
    }
  }
  return segments;
}

}  // namespace

TEST_CASE("drawn track: positions are the integral of the directions, on random tracks of all pieces") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
  for (int i = 0; i < 40; ++i) {
    const DrawnTrack track(Angle::from_degrees(random.between(-80.0, 80.0)), random_segments(random));
    const std::vector<double> joints = track.breaks();
    CHECK(joints.front() == 0.0);
    CHECK(joints.back() == track.length());
    double x = 0.0;
    double drop = 0.0;
    for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
      // Within an ulp of a joint the direction is the one before it.
      const auto zeta = [&](double s) {
        return track.slope_angle(std::min(s, std::nextafter(joints[j + 1], 0.0)));
      };
      x += Rule::integrate([&](double s) { return std::cos(zeta(s)); }, joints[j], joints[j + 1], 8, 1e-15);
      drop +=
          Rule::integrate([&](double s) { return std::sin(zeta(s)); }, joints[j], joints[j + 1], 8, 1e-15);
      const CenterlinePoint point = track.at(joints[j + 1]);
      CHECK(std::fabs(point.x - x) <= 4.0 * kDrawnTrackAccuracy * track.length());
      CHECK(std::fabs(point.drop - drop) <= 4.0 * kDrawnTrackAccuracy * track.length());
    }
    for (int k = 0; k < 10; ++k) {
      const double s = random.between(0.01, 0.99) * track.length();
      const double h = 1e-5;
      const bool across =
          std::any_of(joints.begin(), joints.end(), [&](double at) { return std::fabs(at - s) <= h; });
      if (across) continue;
      const double slope = (track.slope_angle(s + h) - track.slope_angle(s - h)) / (2.0 * h);
      CHECK(track.at(s).curvature == Approx(-slope).margin(1e-7));
      CHECK(track.direction(s).curvature == track.at(s).curvature);
      CHECK(track.direction(s).slope_angle == track.at(s).slope_angle);
    }
  }
}

TEST_CASE("drawn track: ridden from its other end it is the track of its segments turned round") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 40; ++i) {
    const double entry = random.between(-1.0, 1.0);
    const std::vector<TrackSegment> segments = random_segments(random);
    const DrawnTrack track(Angle::from_radians(entry), segments);
    const CenterlinePoint end = track.at(track.length());
    // Backwards and seen in a mirror: slope angles and turns change their sign.
    std::vector<TrackSegment> turned(segments.rbegin(), segments.rend());
    for (TrackSegment& segment : turned) {
      if (auto* const cubic = std::get_if<CubicSegment>(&segment)) {
        cubic->begins_bent = !cubic->begins_bent;
      } else {
        auto& clothoid = std::get<ClothoidSegment>(segment);
        std::swap(clothoid.entry_curvature, clothoid.exit_curvature);
      }
    }
    const DrawnTrack back(Angle::from_radians(-end.slope_angle), turned);
    CHECK(back.length() == Approx(track.length()).epsilon(1e-14));
    for (int k = 0; k <= 20; ++k) {
      const double s = std::min(track.length(), track.length() * k / 20.0);
      const CenterlinePoint there = track.at(s);
      const CenterlinePoint here = back.at(std::min(back.length(), back.length() * (20 - k) / 20.0));
      CHECK(std::fabs((end.x - there.x) - here.x) <= 1e-13 * track.length());
      CHECK(std::fabs((there.drop - end.drop) - here.drop) <= 1e-13 * track.length());
      CHECK(std::fabs(there.slope_angle + here.slope_angle) <= 1e-12);
    }
  }
}

TEST_CASE("drawn track: straight, cubic bend and straight are the in-run of the norm") {
  const InRun in_run(
      {Angle::from_degrees(35.0), Angle::from_degrees(11.0), 103.0, 6.9, 102.9, InRunTransition::cubic, 0.0});
  const DrawnTrack track(Angle::from_degrees(35.0), {ClothoidSegment{in_run.transition_begins(), 0.0, 0.0},
                                                     CubicSegment{Angle::from_degrees(24.0), 103.0, false},
                                                     ClothoidSegment{6.9, 0.0, 0.0}});
  CHECK(track.length() == Approx(in_run.length()).epsilon(kDrawnTrackAccuracy));
  for (int k = 0; k <= 100; ++k) {
    const double s = std::min(track.length(), in_run.length()) * (k / 100.0);
    CHECK(std::fabs(track.at(s).x - in_run.at(s).x) <= kDrawnTrackAccuracy * track.length());
    CHECK(std::fabs(track.at(s).drop - in_run.at(s).drop) <= kDrawnTrackAccuracy * track.length());
    CHECK(track.at(s).curvature == Approx(in_run.at(s).curvature).epsilon(1e-12).margin(1e-15));
  }
}

TEST_CASE("drawn track: clothoid segments alone are the clothoid spline of them") {
  auto random = testing::seeded_random();
  std::vector<ClothoidSegment> pieces;
  std::vector<TrackSegment> segments;
  for (int i = 0; i < 5; ++i) {
    pieces.push_back({random.between(0.2, 5.0), random.between(-0.2, 0.2), random.between(-0.2, 0.2)});
    segments.emplace_back(pieces.back());
  }
  const ClothoidSpline spline(Angle::from_degrees(30.0), pieces);
  const CenterlinePtr track = joined(Angle::from_degrees(30.0), segments);
  CHECK(dynamic_cast<const ClothoidSpline*>(track.get()) != nullptr);
  const DrawnTrack drawn(Angle::from_degrees(30.0), segments);
  for (int k = 0; k <= 20; ++k) {
    const double s = std::min(spline.length(), spline.length() * k / 20.0);
    CHECK(drawn.at(s).x == spline.at(s).x);
    CHECK(drawn.at(s).drop == spline.at(s).drop);
    CHECK(track->at(s).x == spline.at(s).x);
  }
}

TEST_CASE(
    "an arc and a clothoid lead to the place that they are given, at the slope angle that they are given") {
  auto random = testing::seeded_random();
  INFO("GLISSADE_SEED=" << random.seed());
  for (int i = 0; i < 300; ++i) {
    const double size = std::pow(10.0, random.between(-3.0, 4.0));
    const double direction = random.between(-1.5, 1.5);
    const Vec2 way{size * std::cos(direction), size * std::sin(direction)};
    const Angle entry = Angle::from_radians(direction + random.between(-1.5, 1.5));
    const auto arc = arc_to(way, entry);
    REQUIRE(arc);
    CHECK(arc->entry_curvature == arc->exit_curvature);
    const ClothoidSpline on_arc(entry, {*arc});
    CHECK(std::hypot(on_arc.at(on_arc.length()).x - way.x, on_arc.at(on_arc.length()).drop - way.y) <=
          2.0 * kClothoidAccuracy * arc->length);

    const Angle exit = Angle::from_radians(direction + random.between(-1.5, 1.5));
    const auto clothoid = clothoid_to(way, entry, exit);
    CAPTURE(size, direction, entry.degrees(), exit.degrees());
    REQUIRE(clothoid);
    const ClothoidSpline on_clothoid(entry, {*clothoid});
    const CenterlinePoint end = on_clothoid.at(on_clothoid.length());
    CHECK(std::hypot(end.x - way.x, end.drop - way.y) <= 4.0 * kClothoidAccuracy * clothoid->length);
    CHECK(std::fabs(end.slope_angle - exit.radians()) <= 1e-13);
    // Of one that the arc reaches at that very angle it is the arc.
    const Angle of_arc = Angle::from_radians(entry.radians() - arc->length * arc->entry_curvature);
    const auto same = clothoid_to(way, entry, of_arc);
    REQUIRE(same);
    CHECK(same->length == Approx(arc->length).epsilon(1e-12));
  }
  CHECK_FALSE(arc_to({-1.0, 0.0}, Angle()));
  for (const Vec2 way : {Vec2{std::nan(""), 0.0}, Vec2{1.0, HUGE_VAL}, Vec2{}}) {
    CHECK_THROWS_AS(arc_to(way, Angle()), InputError);
    CHECK_THROWS_AS(clothoid_to(way, Angle(), Angle()), InputError);
  }
  CHECK_THROWS_AS(arc_to({1.0, 0.0}, Angle::from_radians(std::nan(""))), InputError);
  CHECK(arc_to({2.0, 0.0}, Angle()) == ClothoidSegment{2.0, 0.0, 0.0});
  CHECK_FALSE(clothoid_to({1.0, 0.0}, Angle::from_degrees(170.0), Angle()));
}

TEST_CASE("drawn track: what cannot be a segment is refused") {
  CHECK_THROWS_AS(DrawnTrack(Angle(), {}), InputError);
  CHECK_THROWS_AS(DrawnTrack(Angle(), {CubicSegment{Angle::from_degrees(60.0), 5.0, false}}), InputError);
  CHECK_THROWS_AS(DrawnTrack(Angle(), {CubicSegment{Angle(), 5.0, false}}), InputError);
  CHECK_THROWS_AS(DrawnTrack(Angle(), {CubicSegment{Angle::from_degrees(10.0), -5.0, false}}), InputError);
  CHECK_THROWS_AS(DrawnTrack(Angle(), {ClothoidSegment{-1.0, 0.0, 0.0}}), InputError);
}

TEST_CASE("a drawn track without a finite direction or end is refused, whichever segment comes first") {
  const CubicSegment cubic{Angle::from_degrees(20.0), 10.0, false};
  const ClothoidSegment straight{1.0, 0.0, 0.0};
  for (const double entry : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    const Angle angle = Angle::from_radians(entry);
    CHECK_THROWS_WITH(DrawnTrack(angle, {cubic, straight}), Catch::Matchers::Contains("entry slope angle"));
    CHECK_THROWS_WITH(joined(angle, {cubic}), Catch::Matchers::Contains("deg is not finite"));
    CHECK_THROWS_AS(joined(angle, {straight, cubic}), InputError);
  }
  const ClothoidSegment long_one{1e308, 0.0, 0.0};
  CHECK_THROWS_WITH(joined(Angle(), {long_one, long_one}),
                    Catch::Matchers::Contains("segments: their length is beyond the range of numbers"));
  CHECK_THROWS_WITH(DrawnTrack(Angle(), {long_one, cubic, long_one}),
                    Catch::Matchers::Contains("segments: their length is beyond the range of numbers"));
}
